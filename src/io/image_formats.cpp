#include "io/image_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/sample_formats.h"
#include "rpf/error.h"
#include "rpf/srgb.h"

namespace rpf::io {
namespace {

// OpenImageIO writes more formats, but they hold 8 or 16 linear bits, cannot be checked, or print to the terminal.
constexpr int any_size = 1 << 20, byte_pairs = 65535;
const std::array<ImageFormat, 14> formats = {{{".exr", Encoding::linear_float, true, true, false, any_size},
                                              {".tif", Encoding::linear_float, true, true, true, any_size},
                                              {".tiff", Encoding::linear_float, true, true, true, any_size},
                                              {".hdr", Encoding::linear_float, false, false, true, any_size},
                                              {".rgbe", Encoding::linear_float, false, false, true, any_size},
                                              {".png", Encoding::srgb_bytes, false, true, true, 1000000},
                                              {".jpg", Encoding::srgb_bytes, false, false, true, 65500},
                                              {".jpeg", Encoding::srgb_bytes, false, false, true, 65500},
                                              {".bmp", Encoding::srgb_bytes, false, true, true, any_size},
                                              {".tga", Encoding::srgb_bytes, false, true, true, byte_pairs},
                                              {".gif", Encoding::srgb_bytes, false, true, true, byte_pairs},
                                              {".webp", Encoding::srgb_bytes, false, true, true, 16383},
                                              {".ppm", Encoding::srgb_bytes, false, false, true, any_size},
                                              {".pnm", Encoding::srgb_bytes, false, false, true, any_size}}};

// Nearest of 256 levels.
std::uint8_t to_byte(double value) {
  if (!(value > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0) * 255));
}

}  // namespace

const ImageFormat* find_format(const std::string& path) {
  const std::string extension = extension_of(path);
  const auto has_it = [&](const ImageFormat& format) { return extension == format.extension; };
  const auto* found = std::find_if(formats.begin(), formats.end(), has_it);
  return found == formats.end() ? nullptr : &*found;
}

const ImageFormat& format_of(const std::string& path) {
  if (const ImageFormat* format = find_format(path)) return *format;
  std::string known;
  for (const ImageFormat& format : formats) known += std::string(" ") + format.extension;
  throw Error(ErrorKind::output,
              fmt::format("\"{}\" has no extension of an image format that can be written; use one of{}", path, known));
}

std::vector<std::size_t> columns_of(const std::string& path, const ImageFormat& format,
                                    const std::vector<std::string>& channels) {
  std::vector<std::size_t> columns;
  if (format.any_channels) {
    for (std::size_t c = 0; c < channels.size(); ++c) columns.push_back(c);
    return columns;
  }
  for (const char* name : {"R", "G", "B", "A"}) {
    const auto found = std::find(channels.begin(), channels.end(), name);
    const bool is_alpha = *name == 'A';
    if (found != channels.end() && (!is_alpha || format.alpha))
      columns.push_back(static_cast<std::size_t>(found - channels.begin()));
    else if (!is_alpha)
      throw Error(ErrorKind::output, fmt::format("\"{}\" needs the channels R, G and B, but the image has no {}; "
                                                 "write an .exr file instead",
                                                 path, name));
  }
  return columns;
}

void check_size(const std::string& path, const ImageFormat& format, const Window& window) {
  if (std::max(window.width, window.height) > format.longest_side)
    throw Error(ErrorKind::output,
                fmt::format("\"{}\" takes at most {} pixels a side, but the image has {} x {}; write "
                            "an .exr file instead",
                            path, format.longest_side, window.width, window.height));
}

std::vector<std::uint8_t> encode_bytes(const Image& image, const std::vector<std::size_t>& columns) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.data_window.pixel_count() * columns.size());
  for (std::size_t pixel = 0; pixel < image.data_window.pixel_count(); ++pixel) {
    const float* values = image.pixel(pixel);
    const double alpha = columns.size() == 4 ? static_cast<double>(values[columns[3]]) : 1;
    // Color without coverage (glow, sky) has nothing to be divided by and stays.
    const double scale = alpha > 0 && alpha < 1 ? 1 / alpha : 1;
    for (std::size_t c = 0; c < 3; ++c)
      bytes.push_back(to_byte(srgb_encode(static_cast<double>(values[columns[c]]) * scale)));
    if (columns.size() == 4) bytes.push_back(to_byte(alpha));
  }
  return bytes;
}

std::vector<float> gather_floats(const Image& image, const std::vector<std::size_t>& columns) {
  std::vector<float> floats;
  floats.reserve(image.data_window.pixel_count() * columns.size());
  for (std::size_t pixel = 0; pixel < image.data_window.pixel_count(); ++pixel)
    for (const std::size_t column : columns) floats.push_back(image.pixel(pixel)[column]);
  return floats;
}

}  // namespace rpf::io
