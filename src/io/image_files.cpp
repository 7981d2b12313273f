// Images in and out: EXR is written with OpenEXR itself, everything else goes through OpenImageIO.
#include <fmt/format.h>

#include "io/atomic_file.h"
#include "io/exr_image.h"
#include "io/image_formats.h"
#include "io/image_library.h"
#include "io/reading.h"
#include "rpf/error.h"
#include "rpf/io.h"

namespace rpf {
namespace {

void check_image(const std::string& path, const Image& image) {
  if (image.channels.empty() || image.data_window.width <= 0 || image.data_window.height <= 0 ||
      image.pixels.size() != image.data_window.pixel_count() * image.channel_count())
    throw Error(ErrorKind::internal,
                fmt::format("the image for \"{}\" has {} values for {} x {} pixels of {} channels; "
                            "report this defect",
                            path, image.pixels.size(), image.data_window.width, image.data_window.height,
                            image.channel_count()));
}

}  // namespace

Image inspect_image(const std::string& path) { return io::image_library(ErrorKind::input, path).inspect(path); }

std::uint64_t image_bytes(const Image& header) {
  // As floats, and what some formats unpack as a whole: half of that, for 16 bits a channel.
  return header.data_window.pixel_count() * header.channel_count() * (sizeof(float) + sizeof(std::uint16_t));
}

Image read_image(const std::string& path, std::uint64_t max_memory) {
  if (max_memory > 0) io::check_budget(path, image_bytes(inspect_image(path)), max_memory);
  return io::image_library(ErrorKind::input, path).read(path);
}

void write_image(const std::string& path, const Image& image) {
  check_image(path, image);
  io::AtomicFile file(path);  // first: a folder or /dev/full is no question of its extension
  if (io::format_of(path).library)
    io::image_library(ErrorKind::output, path).write(path, file, image);
  else
    io::write_exr_image(path, file, image);
  file.commit();
}

}  // namespace rpf
