// Images in and out: EXR is written with OpenEXR itself, everything else goes through OpenImageIO.
#include <fmt/format.h>

#include "io/atomic_file.h"
#include "io/exr_image.h"
#include "io/image_formats.h"
#include "io/image_library.h"
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

Image read_image(const std::string& path) { return io::image_library(ErrorKind::input, path).read(path); }

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
