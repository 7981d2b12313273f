#include "metrics/convolution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rpf::metrics {
namespace {

int radius_of(const Weights& weights) { return static_cast<int>(weights.size()) / 2; }

/// `value(offset)` weighted and summed.
template <class Function>
double weighted_sum(const Weights& weights, Function value) {
  const int radius = radius_of(weights);
  double result = 0;
  const double* center = weights.data() + radius;
  for (int d = -radius; d <= radius; ++d) result += center[d] * value(d);
  return result;
}

template <class Function>
Plane filled(int width, int height, Function value) {
  Plane plane{width, height, {}};
  plane.values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) plane.values.push_back(value(x, y));
  return plane;
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
  const int right = plane.width - 1, bottom = plane.height - 1;
  const Plane rows = filled(plane.width, plane.height, [&](int x, int y) {
    return weighted_sum(along_x, [&](int d) { return plane.at(std::clamp(x + d, 0, right), y); });
  });
  return filled(plane.width, plane.height, [&](int x, int y) {
    return weighted_sum(along_y, [&](int d) { return rows.at(x, std::clamp(y + d, 0, bottom)); });
  });
}

}  // namespace rpf::metrics
