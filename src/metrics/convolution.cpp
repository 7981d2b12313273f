#include "metrics/convolution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rpf::metrics {
namespace {

std::size_t radius_of(const Weights& weights) { return weights.size() / 2; }

/// Adds weight * values to sums, element by element: whole rows at a time keep a vector unit busy, and each sum still
/// runs over the offsets in their order.
void add_scaled(double weight, const double* values, std::size_t count, double* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] += weight * values[i];
}

Plane empty_like(const Plane& plane) {
  return {plane.width, plane.height, std::vector<double>(plane.values.size(), 0)};
}

Plane along_rows(const Plane& plane, const Weights& weights) {
  const auto width = static_cast<std::size_t>(plane.width);
  const auto radius = static_cast<std::ptrdiff_t>(radius_of(weights));
  Plane result = empty_like(plane);
  std::vector<double> padded(width + 2 * radius_of(weights));
  for (std::size_t begin = 0; begin < plane.values.size(); begin += width) {
    const double* row = plane.values.data() + begin;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + radius);
    std::fill_n(padded.end() - radius, radius, row[width - 1]);
    for (std::size_t d = 0; d < weights.size(); ++d)
      add_scaled(weights[d], padded.data() + d, width, result.values.data() + begin);
  }
  return result;
}

Plane along_columns(const Plane& plane, const Weights& weights) {
  const auto width = static_cast<std::size_t>(plane.width);
  const int radius = static_cast<int>(radius_of(weights));
  const double* center = weights.data() + radius;
  Plane result = empty_like(plane);
  for (int y = 0; y < plane.height; ++y)
    for (int d = -radius; d <= radius; ++d) {
      const auto from = static_cast<std::size_t>(std::clamp(y + d, 0, plane.height - 1));
      add_scaled(center[d], plane.values.data() + from * width, width,
                 result.values.data() + static_cast<std::size_t>(y) * width);
    }
  return result;
}

}  // namespace

Weights gaussian(double sigma, int radius) {
  Weights weights;
  for (int d = -radius; d <= radius; ++d) weights.push_back(std::exp(-d * d / (2 * sigma * sigma)));
  return weights;
}

double sum(const Weights& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

Weights scaled(Weights weights, double factor) {
  for (double& weight : weights) weight *= factor;
  return weights;
}

Plane convolve(const Plane& plane, const Weights& along_x, const Weights& along_y) {
  return along_columns(along_rows(plane, along_x), along_y);
}

}  // namespace rpf::metrics
