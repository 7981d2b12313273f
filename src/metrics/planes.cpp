#include "metrics/planes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>

#include "rpf/error.h"

namespace rpf::metrics {
namespace {

std::size_t channel_of(const Image& image, const char* name, const char* role) {
  if (const auto column = image.find(name)) return *column;
  throw Error(ErrorKind::input, fmt::format("the {} has no channel {}; R, G and B are compared, and it has {}", role,
                                            name, fmt::join(image.channels, ", ")));
}

Plane plane_of(const Image& image, const char* name, const char* role) {
  const std::size_t column = channel_of(image, name, role);
  Plane plane{image.data_window.width, image.data_window.height, {}};
  plane.values.resize(image.data_window.pixel_count());
  for (std::size_t p = 0; p < plane.values.size(); ++p) plane.values[p] = image.pixel(p)[column];
  return plane;
}

ColorPlanes color_of(const Image& image, const char* role) {
  return {plane_of(image, "R", role), plane_of(image, "G", role), plane_of(image, "B", role)};
}

}  // namespace

Pair planes_of(const Image& image, const Image& reference) {
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
  return {color_of(image, "image"), color_of(reference, "reference")};
}

double mean(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

}  // namespace rpf::metrics
