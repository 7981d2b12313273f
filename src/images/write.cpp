// Images out, through OpenImageIO on a writer that loses no error.
#include "images/images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>

#include "io/attributes.h"
#include "io/checked_writer.h"
#include "io/guard.h"
#include "io/image_formats.h"
#include "rpf/error.h"

namespace rpf::images {
namespace {

namespace oiio = OIIO;
using namespace rpf::io;

// OpenImageIO's window to a CheckedWriter.
class WriterProxy : public oiio::Filesystem::IOProxy {
 public:
  WriterProxy(CheckedWriter& writer, const std::string& name) : IOProxy(name, Write), writer_(writer) {}
  const char* proxytype() const override { return "rpf"; }
  std::size_t write(const void* data, std::size_t count) override { return writer_.write(data, count) ? count : 0; }
  bool seek(std::int64_t offset) override { return writer_.seek(static_cast<std::uint64_t>(offset)); }
  std::int64_t tell() override { return static_cast<std::int64_t>(writer_.position()); }
  std::size_t size() const override { return writer_.size(); }

 private:
  CheckedWriter& writer_;
};

// Typed so that OpenImageIO writes v2f, v3f, m33f and m44f attributes; other lengths become float vectors.
void put_floats(oiio::ImageSpec& spec, const std::string& name, const std::vector<float>& floats) {
  if (floats.empty()) return;
  oiio::TypeDesc type(oiio::TypeDesc::FLOAT, static_cast<int>(floats.size()));
  if (floats.size() == 2) type = oiio::TypeDesc(oiio::TypeDesc::FLOAT, oiio::TypeDesc::VEC2);
  if (floats.size() == 3) type = oiio::TypeVector;
  if (floats.size() == 9) type = oiio::TypeMatrix33;
  if (floats.size() == 16) type = oiio::TypeMatrix44;
  spec.attribute(name, type, floats.data());
}

void put_metadata(oiio::ImageSpec& spec, const Metadata& metadata) {
  for (const auto& [exr_name, value] : metadata) {
    if (is_structural(exr_name)) continue;
    const std::string name = oiio_name(exr_name);
    if (const auto* number = std::get_if<std::int32_t>(&value)) spec.attribute(name, *number);
    if (const auto* real = std::get_if<float>(&value)) spec.attribute(name, *real);
    if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
    if (const auto* floats = std::get_if<std::vector<float>>(&value)) put_floats(spec, name, *floats);
  }
}

oiio::ImageSpec spec_of(const ImageFormat& format, const Image& image, const std::vector<std::size_t>& columns) {
  const bool bytes = format.encoding == Encoding::srgb_bytes;
  oiio::ImageSpec spec(image.data_window.width, image.data_window.height, static_cast<int>(columns.size()),
                       bytes ? oiio::TypeUInt8 : oiio::TypeFloat);
  for (std::size_t c = 0; c < columns.size(); ++c) spec.channelnames[c] = image.channels[columns[c]];
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
  spec.attribute("oiio:ColorSpace", bytes ? "sRGB" : "Linear");
  // OpenImageIO adds the time of writing where there is none; equal images must be equal files.
  spec.attribute("DateTime", "");
  if (bytes) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!bytes) put_metadata(spec, image.metadata);
  if (!bytes) spec.attribute("compression", "zip");
  return spec;
}

[[noreturn]] void fail_format(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::output,
              fmt::format("\"{}\" cannot be written ({}); choose another format or check the disk", path, reason));
}

// Destroying the output may write too, so it is gone before the writer is asked for errors.
void encode(const std::string& path, const std::string& temporary, CheckedWriter& writer, const oiio::ImageSpec& spec,
            const void* pixels) {
  WriterProxy proxy(writer, temporary);
  std::string failure;
  {
    const auto output = oiio::ImageOutput::create(temporary, &proxy);
    if (!output) fail_format(path, oiio::geterror());
    const bool done = output->open(temporary, spec) && output->write_image(spec.format, pixels);
    const bool closed = output->close();
    if (!done || !closed) failure = output->geterror();
    if (failure.empty() && !(done && closed)) failure = "no reason given";
  }
  writer.finish();
  if (!failure.empty()) fail_format(path, failure);
}

// Reads everything back: a file that its own reader refuses must not replace a good one.
void check_written(const std::string& path, const std::string& temporary, const oiio::ImageSpec& spec) {
  const auto input = oiio::ImageInput::open(temporary);
  if (!input) fail_format(path, "it cannot be read back: " + oiio::geterror());
  const oiio::ImageSpec& back = input->spec();
  const bool dropped_alpha = back.nchannels == 3 && spec.nchannels == 4;  // WebP does so where all is opaque
  if (back.width != spec.width || back.height != spec.height || (back.nchannels != spec.nchannels && !dropped_alpha))
    fail_format(path, fmt::format("{} x {} pixels of {} channels came back instead of {} x {} of {}", back.width,
                                  back.height, back.nchannels, spec.width, spec.height, spec.nchannels));
  std::vector<char> pixels(back.image_bytes(true));
  if (!input->read_image(0, 0, 0, back.nchannels, oiio::TypeUnknown, pixels.data()) || input->has_error())
    fail_format(path, "it cannot be read back: " + input->geterror());
}

}  // namespace

void write(const std::string& path, const io::AtomicFile& file, const Image& image) {
  const ImageFormat& format = format_of(path);
  const std::vector<std::size_t> columns = columns_of(path, format, image.channels);
  const oiio::ImageSpec spec = spec_of(format, image, columns);
  CheckedWriter writer(file.descriptor(), path);
  if (format.encoding == Encoding::srgb_bytes)
    encode(path, file.temporary_path(), writer, spec, encode_bytes(image, columns).data());
  else if (format.any_channels)
    encode(path, file.temporary_path(), writer, spec, image.pixels.data());
  else
    encode(path, file.temporary_path(), writer, spec, gather_floats(image, columns).data());
  check_written(path, file.temporary_path(), spec);
}

}  // namespace rpf::images
