#include <fmt/format.h>
#include <fmt/ranges.h>

#include "metrics/flip.h"
#include "metrics/hdr_flip.h"
#include "metrics/pixel_error.h"
#include "metrics/structural_similarity.h"
#include "metrics/tone_curve.h"
#include "rpf/error.h"
#include "rpf/metrics.h"

namespace rpf {
namespace {

void check_color(const Image& image, const char* role) {
  for (const char* name : {"R", "G", "B"})
    if (!image.find(name))
      throw Error(ErrorKind::input, fmt::format("the {} has no channel {}; R, G and B are compared, and it has {}",
                                                role, name, fmt::join(image.channels, ", ")));
}

}  // namespace

std::uint64_t comparing_bytes(std::uint64_t pixels) {
  // Of both images R, G and B as they are, as displayed, as exposed and as opponents; the relative errors; the FLIP so
  // far; what the eye sees of one image, and on the way to that of the other. The widest moment is inside HDR-FLIP.
  constexpr std::uint64_t planes = 4 * 2 * 3 + 1 + 1 + 3 + 2 * 3 + 3;
  return pixels * planes * sizeof(double);
}

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
  check_color(image, "image");
  check_color(reference, "reference");
}

ImageError compare_images(const Image& image, const Image& reference) {
  const metrics::Pair pair = metrics::planes_of(image, reference);
  const metrics::Pair shown{metrics::displayed(pair.image), metrics::displayed(pair.reference)};
  const metrics::Plane relative = metrics::relative_squared_error(pair);
  ImageError error;
  error.mse = metrics::mean_squared_error(pair);
  error.relmse = metrics::mean(relative);
  error.trimmed_relmse = metrics::trimmed_mean(relative);
  error.mae = metrics::mean_absolute_error(pair);
  error.energy = metrics::energy_ratio(pair);
  error.largest = metrics::largest_differences(pair, reference.data_window);
  error.psnr = metrics::peak_signal_to_noise(shown);
  error.ssim = metrics::structural_similarity(shown);
  error.flip = metrics::mean(metrics::flip_map({metrics::clamped(pair.image), metrics::clamped(pair.reference)}));
  error.hdr_flip = metrics::mean(metrics::hdr_flip_map(pair));
  return error;
}

Image relative_error_map(const Image& image, const Image& reference) {
  const metrics::Plane errors = metrics::relative_squared_error(metrics::planes_of(image, reference));
  Image map;
  map.data_window = reference.data_window;
  map.display_window = reference.display_window;
  map.channels = {"relMSE"};
  map.pixels.assign(errors.values.begin(), errors.values.end());
  return map;
}

}  // namespace rpf
