// Which image formats are written, and how an image becomes what they store.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rpf/image.h"

namespace rpf::io {

enum class Encoding { srgb_bytes, linear_float };

struct ImageFormat {
  const char* extension;
  Encoding encoding;
  bool any_channels;  ///< else R, G, B
  bool alpha;         ///< A beside R, G, B
  bool library;       ///< written by the library of images (image_library.h)
  int longest_side;   ///< pixels of width or height that the format or its library takes
};

/// The format by the extension of `path`, in any case of letters; null where it is of none.
const ImageFormat* find_format(const std::string& path);

/// The same; throws Error(output) that lists all extensions where it is of none.
const ImageFormat& format_of(const std::string& path);

/// Columns of an image with these channels that the format stores, in its order. Throws Error(output) where R, G or B
/// is missing.
std::vector<std::size_t> columns_of(const std::string& path, const ImageFormat& format,
                                    const std::vector<std::string>& channels);

/// Throws Error(output) where the format takes no image of that size.
void check_size(const std::string& path, const ImageFormat& format, const Window& window);

/// Three or four columns as sRGB bytes: clamped to [0,1], rounded to nearest, NaN as 0. Bytes are stored not multiplied
/// by alpha, as PNG demands; alpha itself is linear.
std::vector<std::uint8_t> encode_bytes(const Image& image, const std::vector<std::size_t>& columns);

/// The columns side by side.
std::vector<float> gather_floats(const Image& image, const std::vector<std::size_t>& columns);

}  // namespace rpf::io
