#include "scene/counts.h"

#include <fmt/format.h>

#include <cmath>

#include "rpf/error.h"
#include "scene/random.h"

namespace rpf::scene {
namespace {

constexpr std::uint32_t counts_key = 0xc0117500U;  // apart from everything else that the seed decides

void check_density(const Image& density, const SceneOptions& options) {
  const Window frame{0, 0, options.width, options.height};
  if (!(density.data_window == frame))
    throw Error(ErrorKind::usage,
                fmt::format("scene: the density image has the data window {}; the frame's {} is expected",
                            text_of(density.data_window), text_of(frame)));
  for (std::size_t p = 0; p < density.data_window.pixel_count(); ++p)
    if (const float value = density.pixel(p)[0]; !std::isfinite(value) || value < 0)
      throw Error(ErrorKind::usage, fmt::format("scene: the density image has the value {} in pixel {},{}; a finite "
                                                "number, 0 or more, is expected",
                                                value, p % options.width, p / options.width));
}

/// Wanted number of samples of a pixel. `random` is in [0, 1).
double wanted(const SceneOptions& options, std::size_t pixel, float random) {
  const double samples = options.samples;
  if (options.density) return samples * options.density->pixel(pixel)[0] + random;
  return options.adaptive ? (2 * samples + 1) * random : samples;
}

}  // namespace

std::vector<std::uint32_t> first_samples(const SceneOptions& options) {
  if (options.density) check_density(*options.density, options);
  const std::size_t pixels = Window{0, 0, options.width, options.height}.pixel_count();
  std::vector<std::uint32_t> first = {0};
  first.reserve(pixels + 1);
  double total = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const float random = to_unit(hash(hash(options.seed, counts_key), static_cast<std::uint32_t>(pixel)));
    total += std::floor(wanted(options, pixel, random));
    if (total > static_cast<double>(most_samples_of_frame))
      throw Error(ErrorKind::usage, fmt::format("scene: more than {} samples in the frame; choose a smaller --size, "
                                                "--spp or density",
                                                most_samples_of_frame));
    first.push_back(static_cast<std::uint32_t>(total));
  }
  return first;
}

}  // namespace rpf::scene
