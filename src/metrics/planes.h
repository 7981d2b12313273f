// What the metrics read: R, G and B of two images of equal size, one plane of doubles each.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rpf/image.h"

namespace rpf::metrics {

struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;  ///< row-major

  double at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
};

using ColorPlanes = std::array<Plane, 3>;  ///< of equal size

struct Pair {
  ColorPlanes image, reference;
};

/// Throws Error(input) where sizes differ or a channel is missing.
Pair planes_of(const Image& image, const Image& reference);

/// `function` of every value.
template <class Function>
Plane mapped(Plane plane, Function function) {
  for (double& value : plane.values) value = function(value);
  return plane;
}

/// `function` of the values of two planes of equal size.
template <class Function>
Plane combined(Plane a, const Plane& b, Function function) {
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = function(a.values[i], b.values[i]);
  return a;
}

double mean(const Plane& plane);

}  // namespace rpf::metrics
