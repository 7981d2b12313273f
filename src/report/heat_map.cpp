#include "report/heat_map.h"

#include <algorithm>
#include <cmath>

#include "report/picture.h"
#include "rpf/srgb.h"

namespace rpf::report {
namespace {

constexpr int bar_width = 16, tick_width = 6;  ///< pixels
const double decades = std::log10(brightest_error / darkest_error);

using Color = std::array<float, 3>;

void put(Image& image, int x, int y, const Color& color) {
  std::copy(color.begin(), color.end(), image.pixel(static_cast<std::size_t>(y) * image.data_window.width + x));
}

void draw_bar(Image& image, int left) {
  const int last = image.data_window.height - 1;
  for (int y = 0; y <= last; ++y)
    for (int x = 0; x < bar_width; ++x)
      put(image, left + x, y, color_at(1 - static_cast<double>(y) / std::max(last, 1)));
  for (int k = 0; k <= std::lround(decades); ++k)
    for (int x = 0; x < tick_width; ++x)
      put(image, left + bar_width + x, static_cast<int>(std::lround(last * k / decades)), {0, 0, 0});
}

}  // namespace

std::array<float, 3> color_at(double position) {
  const double inside = position < 1 ? std::max(position, 0.0) : 1.0;  // NaN: 1
  return linear_light(magma[static_cast<std::size_t>(std::lround(inside * 255))]);
}

std::array<float, 3> linear_light(std::uint32_t rgb) {
  Color color;
  for (unsigned c = 0; c < 3; ++c)
    color[c] = static_cast<float>(srgb_decode(static_cast<double>(rgb >> (16 - 8 * c) & 0xffU) / 255));
  return color;
}

Image heat_map(const Image& errors) {
  Image picture = plain_picture(errors.data_window.width, errors.data_window.height, 1);
  for (std::size_t p = 0; p < errors.pixels.size(); ++p) {
    const Color color = color_at(std::log10(static_cast<double>(errors.pixels[p]) / darkest_error) / decades);
    std::copy(color.begin(), color.end(), picture.pixel(p));
  }
  return picture;
}

Image with_legend(const Image& picture) {
  const int width = picture.data_window.width, height = picture.data_window.height;
  Image result = plain_picture(width + picture_gap + bar_width + tick_width, height, 1);
  for (int y = 0; y < height; ++y) {
    const float* row = picture.pixel(static_cast<std::size_t>(y) * width);
    std::copy(row, row + 3 * static_cast<std::size_t>(width),
              result.pixel(static_cast<std::size_t>(y) * result.data_window.width));
  }
  draw_bar(result, width + picture_gap);
  return result;
}

}  // namespace rpf::report
