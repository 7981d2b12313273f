// What both writers of OpenEXR, of samples and of images, need of it.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <string>

#include "io/checked_writer.h"
#include "rpf/image.h"

namespace rpf::io {

/// OpenEXR's window to a CheckedWriter. OpenEXR stops at an exception; the reason stays in the writer.
class WriterStream : public Imf::OStream {
 public:
  WriterStream(CheckedWriter& writer, const std::string& name) : OStream(name.c_str()), writer_(writer) {}
  void write(const char* bytes, int count) override;
  std::uint64_t tellp() override { return writer_.position(); }
  void seekp(std::uint64_t position) override { writer_.seek(position); }

 private:
  CheckedWriter& writer_;
};

/// Inserts an attribute in the type that OpenEXR has for it. Throws OpenEXR's exception where the header already has
/// one of that name and another type.
void insert_attribute(Imf::Header& header, const std::string& name, const Attribute& value);

Imath::Box2i box_of(const Window& window);

}  // namespace rpf::io
