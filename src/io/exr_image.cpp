#include "io/exr_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <vector>

#include "io/attributes.h"
#include "io/exr_output.h"
#include "io/guard.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

Imf::Header header_of(const Image& image) {
  Imf::Header header(box_of(image.display_window), box_of(image.data_window));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : image.metadata) {
    const auto* floats = std::get_if<std::vector<float>>(&value);
    if (is_structural(name) || (floats != nullptr && floats->empty())) continue;
    try {
      insert_attribute(header, name, value);
    } catch (const std::exception&) {  // one that OpenEXR has itself, in another type: its own stays
    }
  }
  // What a damaged input carries along must not cost the image.
  const float aspect = header.pixelAspectRatio();
  if (!(aspect >= 1e-6F && aspect <= 1e6F)) header.pixelAspectRatio() = 1;
  if (!(header.screenWindowWidth() >= 0)) header.screenWindowWidth() = 1;
  return header;
}

/// The pixels of a frame buffer; OpenEXR only reads them while it writes a file.
Imf::FrameBuffer buffer_of(const Image& image, const float* pixels) {
  const std::size_t stride = image.channel_count() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < image.channel_count(); ++c)
    buffer.insert(image.channels[c], Imf::Slice::Make(Imf::FLOAT, pixels + c, box_of(image.data_window), stride,
                                                      stride * static_cast<std::size_t>(image.data_window.width)));
  return buffer;
}

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::output,
              fmt::format("\"{}\" cannot be written ({}); check its channels, its metadata and the disk", path,
                          first_line(reason)));
}

/// A file that its own reader refuses must not replace a good one. Row by row: a second image need not fit beside it.
void check_written(const std::string& path, const std::string& temporary, const Image& image) {
  Imf::InputFile back(temporary.c_str(), 0);
  if (back.header().dataWindow() != box_of(image.data_window)) fail(path, "another data window came back");
  Image row;
  row.data_window = {image.data_window.x, 0, image.data_window.width, 1};
  row.channels = image.channels;
  row.pixels.resize(row.data_window.pixel_count() * row.channel_count());
  for (int y = image.data_window.y; y < image.data_window.y + image.data_window.height; ++y) {
    row.data_window.y = y;
    back.setFrameBuffer(buffer_of(row, row.pixels.data()));
    back.readPixels(y);
  }
}

}  // namespace

void write_exr_image(const std::string& path, const AtomicFile& file, const Image& image) {
  CheckedWriter writer(file.descriptor(), path);
  try {
    WriterStream stream(writer, path);
    Imf::OutputFile output(stream, header_of(image), 0);  // 0: no threads of its own
    output.setFrameBuffer(buffer_of(image, image.pixels.data()));
    output.writePixels(image.data_window.height);
  } catch (const std::exception& error) {
    writer.finish();  // throws the reason if it was a failed write
    fail(path, error.what());
  }
  writer.finish();  // after the output is gone: that writes too
  try {
    check_written(path, file.temporary_path(), image);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(path, std::string("it cannot be read back: ") + error.what());
  }
}

}  // namespace rpf::io
