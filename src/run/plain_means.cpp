#include "run/plain_means.h"

#include <algorithm>
#include <cmath>

#include "frame/resolve.h"

namespace rpf {
namespace {

/// Up to so many samples a pixel is what its network makes of it.
constexpr std::uint32_t few_samples = 45;

/// For all pixels of the crop in some rows, row by row.
template <typename Use>
void for_pixels(const FrameFacts& facts, int first_row, int end_row, Use use) {
  const Window& crop = facts.crop;
  for (int y = std::max(first_row, crop.y); y < std::min(end_row, crop.y + crop.height); ++y)
    for (int x = crop.x; x < crop.x + crop.width; ++x)
      use(static_cast<std::size_t>(y) * static_cast<std::size_t>(facts.width) + static_cast<std::size_t>(x));
}

}  // namespace

bool has_own_share(std::uint32_t samples) { return samples > few_samples; }

double own_share(std::uint32_t samples, const float* result, const float* mean, float exposure) {
  if (!has_own_share(samples)) return 0;
  double apart = 0, brightness = 0.06 / exposure;
  for (std::size_t c = 0; c < 3; ++c) {
    apart += std::fabs(static_cast<double>(mean[c]) - result[c]);
    brightness += std::fabs(static_cast<double>(result[c]));
  }
  const double distance = 40 * apart / brightness, n = samples;
  return (1 - std::sqrt(few_samples / n)) * n / (n + distance * distance);
}

float drawn(float result, float mean, double share) {
  return static_cast<float>(result + share * (static_cast<double>(mean) - result));
}

PlainMeans::PlainMeans(const PreparedFrame& prepared) : prepared_(prepared) {}

void PlainMeans::add_rows(int first, int end) {
  std::vector<double> mean(prepared_.facts.carried);
  for_pixels(prepared_.facts, first, end, [&](std::size_t pixel) {
    const bool is_needed = has_own_share(prepared_.frame.samples(pixel));
    mean_of_pixel(prepared_.frame, pixel, is_needed ? mean.size() : 3, mean.data());
    for (std::size_t c = 0; c < 3; ++c) energy_ += mean[c];
    if (is_needed) means_.insert(means_.end(), mean.begin(), mean.end());
  });
}

void PlainMeans::draw_to_means(Pixels& pixels, float exposure) const {
  const std::size_t carried = prepared_.facts.carried;
  const float* mean = means_.data();
  for_pixels(prepared_.facts, 0, prepared_.facts.height, [&](std::size_t pixel) {
    const std::uint32_t samples = prepared_.frame.samples(pixel);
    if (!has_own_share(samples)) return;
    float* result = pixels.data() + pixel * carried;
    const double share = own_share(samples, result, mean, exposure);
    for (std::size_t c = 0; c < carried; ++c) result[c] = drawn(result[c], mean[c], share);
    mean += carried;
  });
}

}  // namespace rpf
