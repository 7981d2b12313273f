#include "metrics/planes.h"

#include <numeric>

#include "rpf/metrics.h"

namespace rpf::metrics {
namespace {

Plane plane_of(const Image& image, const char* name) {
  const std::size_t column = *image.find(name);
  Plane plane{image.data_window.width, image.data_window.height, {}};
  plane.values.resize(image.data_window.pixel_count());
  for (std::size_t p = 0; p < plane.values.size(); ++p) plane.values[p] = image.pixel(p)[column];
  return plane;
}

ColorPlanes color_of(const Image& image) { return {plane_of(image, "R"), plane_of(image, "G"), plane_of(image, "B")}; }

}  // namespace

Pair planes_of(const Image& image, const Image& reference) {
  check_comparable(image, reference);
  return {color_of(image), color_of(reference)};
}

double mean(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

}  // namespace rpf::metrics
