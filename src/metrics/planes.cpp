#include "metrics/planes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>

#include "rpf/error.h"
#include "rpf/metrics.h"

namespace rpf::metrics {
namespace {

constexpr const char* color[] = {"R", "G", "B"};

void check_color(const Image& image, const char* role) {
  for (const char* name : color)
    if (!image.find(name))
      throw Error(ErrorKind::input, fmt::format("the {} has no channel {}; R, G and B are compared, and it has {}",
                                                role, name, fmt::join(image.channels, ", ")));
}

Plane plane_of(const Image& image, const char* name) {
  const std::size_t column = *image.find(name);
  Plane plane{image.data_window.width, image.data_window.height, {}};
  plane.values.resize(image.data_window.pixel_count());
  for (std::size_t p = 0; p < plane.values.size(); ++p) plane.values[p] = image.pixel(p)[column];
  return plane;
}

ColorPlanes color_of(const Image& image) {
  return {plane_of(image, color[0]), plane_of(image, color[1]), plane_of(image, color[2])};
}

}  // namespace

Pair planes_of(const Image& image, const Image& reference) {
  check_comparable(image, reference);
  return {color_of(image), color_of(reference)};
}

double mean(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

}  // namespace rpf::metrics

namespace rpf {

void check_comparable(const Image& image, const Image& reference) {
  const Window &a = image.data_window, &b = reference.data_window;
  if (!(a == b))
    throw Error(ErrorKind::input,
                fmt::format("the image has the data window {}, its reference {}; pixels of one place are "
                            "compared: crop or move one of them",
                            text_of(a), text_of(b)));
  if (!image.view.empty() && !reference.view.empty() && image.view != reference.view)
    throw Error(ErrorKind::input, fmt::format("the image is of the view \"{}\", its reference of \"{}\"; one view is "
                                              "compared with itself",
                                              image.view, reference.view));
  metrics::check_color(image, "image");
  metrics::check_color(reference, "reference");
}

}  // namespace rpf
