#include "io/image_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "rpf/error.h"
#include "rpf/srgb.h"

namespace rpf::io {
namespace {

// OpenImageIO writes more formats, but they hold 8 or 16 linear bits, cannot be checked, or print to the terminal.
const std::array<ImageFormat, 14> formats = {{{".exr", Encoding::linear_float, true, true},
                                              {".tif", Encoding::linear_float, true, true},
                                              {".tiff", Encoding::linear_float, true, true},
                                              {".hdr", Encoding::linear_float, false, false},
                                              {".rgbe", Encoding::linear_float, false, false},
                                              {".png", Encoding::srgb_bytes, false, true},
                                              {".jpg", Encoding::srgb_bytes, false, false},
                                              {".jpeg", Encoding::srgb_bytes, false, false},
                                              {".bmp", Encoding::srgb_bytes, false, true},
                                              {".tga", Encoding::srgb_bytes, false, true},
                                              {".gif", Encoding::srgb_bytes, false, true},
                                              {".webp", Encoding::srgb_bytes, false, true},
                                              {".ppm", Encoding::srgb_bytes, false, false},
                                              {".pnm", Encoding::srgb_bytes, false, false}}};

// Nearest of 256 levels.
std::uint8_t to_byte(double value) {
  if (!(value > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0) * 255));
}

}  // namespace

const ImageFormat& format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  std::string known;
  for (const ImageFormat& format : formats) {
    if (extension == format.extension) return format;
    known += std::string(" ") + format.extension;
  }
  throw Error(ErrorKind::output,
              fmt::format("\"{}\" has no extension of an image format that can be written; use one of{}", path, known));
}

std::vector<std::size_t> columns_of(const std::string& path, const ImageFormat& format, const Image& image) {
  std::vector<std::size_t> columns;
  if (format.any_channels) {
    for (std::size_t c = 0; c < image.channel_count(); ++c) columns.push_back(c);
    return columns;
  }
  for (const char* name : {"R", "G", "B", "A"}) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    const bool is_alpha = *name == 'A';
    if (found != image.channels.end() && (!is_alpha || format.alpha))
      columns.push_back(static_cast<std::size_t>(found - image.channels.begin()));
    else if (!is_alpha)
      throw Error(ErrorKind::output, fmt::format("\"{}\" needs the channels R, G and B, but the image has no {}; "
                                                 "write an .exr file instead",
                                                 path, name));
  }
  return columns;
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
