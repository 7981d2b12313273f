#include "frame/sums_around.h"

#include <algorithm>
#include <cstddef>

namespace rpf {

std::vector<double> sums_around(const std::vector<double>& plane, int width, int height, int reach) {
  std::vector<double> rows(plane.size()), sums(plane.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i) rows[at(x, y)] += plane[at(i, y)];
  for (int y = 0; y < height; ++y)
    for (int i = std::max(y - reach, 0); i <= std::min(y + reach, height - 1); ++i)
      for (int x = 0; x < width; ++x) sums[at(x, y)] += rows[at(x, i)];
  return sums;
}

}  // namespace rpf
