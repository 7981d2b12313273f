// Images and the geometry they share with sample buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rpf {

/// A rectangle of pixels: position of its first pixel, and its size. Units: pixels.
struct Window {
  int x = 0, y = 0;
  int width = 0, height = 0;

  /// width * height.
  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  /// The same place and size.
  bool operator==(const Window& o) const { return x == o.x && y == o.y && width == o.width && height == o.height; }
};

/// WxH+X+Y with the signs of X and Y, as 8x6-37-12: what --crop takes.
std::string text_of(const Window& window);

/// Named header values that travel from the input file to the output file. A vector of 9 or 16 floats is a matrix.
using Attribute = std::variant<std::int32_t, float, std::string, std::vector<float>>;
using Metadata = std::map<std::string, Attribute>;

/// A linear floating-point image. `pixels` is row-major and interleaved: [height][width][channel].
struct Image {
  Window data_window;
  Window display_window;
  std::vector<std::string> channels;  ///< for example R, G, B, A, albedo.R
  std::vector<float> pixels;
  Metadata metadata;
  int value_bits = 32;                          ///< as the file stored a value: 8, 16, 32
  std::string view = {};                        ///< of a stereo file: "left", "right"; empty where it says nothing
  std::vector<std::string> half_channels = {};  ///< that were stored as half
  std::vector<std::string> dropped = {};  ///< what the file has beside this: attributes of types without a place here

  /// Values of a pixel.
  std::size_t channel_count() const { return channels.size(); }
  /// Where a pixel has this channel.
  std::optional<std::size_t> find(const std::string& channel) const;
  /// The channels of pixel number `index` (row-major in the data window).
  float* pixel(std::size_t index) { return pixels.data() + index * channels.size(); }
  /// The same, to be read.
  const float* pixel(std::size_t index) const { return pixels.data() + index * channels.size(); }
};

}  // namespace rpf
