#include <fmt/format.h>

#include <algorithm>

#include "rpf/error.h"
#include "rpf/metrics.h"

namespace rpf {
namespace {

constexpr double relmse_floor = 0.01;

std::size_t channel_of(const Image& image, const char* name, const char* role) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), name);
  if (found != image.channels.end()) return static_cast<std::size_t>(found - image.channels.begin());
  throw Error(ErrorKind::input, fmt::format("the {} has no channel {}; R, G and B are compared", role, name));
}

}  // namespace

ImageError compare_images(const Image& image, const Image& reference) {
  const Window &a = image.data_window, &b = reference.data_window;
  if (a.width != b.width || a.height != b.height)
    throw Error(ErrorKind::input,
                fmt::format("the image has {}x{} pixels, its reference {}x{}; equal sizes are expected", a.width,
                            a.height, b.width, b.height));
  ImageError error;
  double image_sum = 0, reference_sum = 0;
  for (const char* name : {"R", "G", "B"}) {
    const std::size_t ci = channel_of(image, name, "image"), cr = channel_of(reference, name, "reference");
    for (std::size_t p = 0; p < a.pixel_count(); ++p) {
      const double x = image.pixel(p)[ci], y = reference.pixel(p)[cr];
      error.mse += (x - y) * (x - y);
      error.relmse += (x - y) * (x - y) / (y * y + relmse_floor);
      image_sum += x;
      reference_sum += y;
    }
  }
  const double values = 3.0 * static_cast<double>(a.pixel_count());
  error.mse /= values;
  error.relmse /= values;
  error.energy = image_sum == reference_sum ? 1 : image_sum / reference_sum;
  return error;
}

}  // namespace rpf
