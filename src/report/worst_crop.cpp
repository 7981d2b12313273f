#include <algorithm>

#include "report/picture.h"

namespace rpf::report {
namespace {

constexpr int share = 4;  ///< of the image's width and height

/// Sums over all rectangles from the first pixel: entry (x, y) of width + 1 columns has those left of x and above y.
std::vector<double> rectangle_sums(const Image& errors) {
  const auto width = static_cast<std::size_t>(errors.data_window.width);
  std::vector<double> sums(width + 1, 0);
  for (std::size_t p = 0; p < errors.pixels.size(); ++p) {
    if (p % width == 0) sums.push_back(0);
    const double error = errors.pixels[p] < 1 ? static_cast<double>(errors.pixels[p]) : 1;  // NaN: 1
    const std::size_t above = sums.size() - width - 1;
    sums.push_back(error + sums.back() + sums[above] - sums[above - 1]);
  }
  return sums;
}

}  // namespace

Window worst_crop(const Image& errors) {
  const int width = errors.data_window.width, height = errors.data_window.height;
  const std::vector<double> sums = rectangle_sums(errors);
  const auto sum = [&](int x, int y) { return sums[static_cast<std::size_t>(y) * (width + 1) + x]; };
  Window crop{0, 0, std::max(width / share, 1), std::max(height / share, 1)};
  const int w = crop.width, h = crop.height;
  double worst = -1;
  for (int y = 0; y + h <= height; ++y)
    for (int x = 0; x + w <= width; ++x) {
      const double error = sum(x + w, y + h) - sum(x, y + h) - sum(x + w, y) + sum(x, y);
      // Sums that differ by rounding only are equal, so that the place does not depend on it.
      if (error <= worst + 1e-9) continue;
      worst = error;
      crop.x = x;
      crop.y = y;
    }
  return crop;
}

}  // namespace rpf::report
