#include "explain/blur.h"

#include <algorithm>
#include <cmath>

namespace rpf {
namespace {

constexpr float reach_in_sigmas = 2.5F;

/// [reach + 1], by distance.
std::vector<float> weights_of(float sigma) {
  std::vector<float> weights;
  for (int d = 0; static_cast<float>(d) <= reach_in_sigmas * sigma; ++d)
    weights.push_back(std::exp(-static_cast<float>(d * d) / (2 * sigma * sigma)));
  return weights;
}

/// Blurs `count` values that are `stride` apart.
void blur_line(float* values, int count, std::ptrdiff_t stride, const std::vector<float>& weights,
               std::vector<float>& line) {
  line.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) line[i] = values[i * stride];
  const int reach = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    for (int j = std::max(i - reach, 0); j <= std::min(i + reach, count - 1); ++j)
      sum += weights[std::abs(j - i)] * line[j];
    values[i * stride] = sum;
  }
}

}  // namespace

void blur(std::vector<float>& plane, int width, int height, float sigma) {
  const std::vector<float> weights = weights_of(sigma);
  std::vector<float> line;
  for (int y = 0; y < height; ++y) blur_line(plane.data() + std::ptrdiff_t{y} * width, width, 1, weights, line);
  for (int x = 0; x < width; ++x) blur_line(plane.data() + x, height, width, weights, line);
}

}  // namespace rpf
