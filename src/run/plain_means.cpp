#include "run/plain_means.h"

#include <algorithm>
#include <cmath>

#include "frame/resolve.h"
#include "parallel/workers.h"

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

double own_share(double samples, const float* result, const float* mean, float exposure) {
  if (samples <= few_samples) return 0;
  double apart = 0, brightness = 0.06 / exposure;
  for (std::size_t c = 0; c < 3; ++c) {
    apart += std::fabs(static_cast<double>(mean[c]) - result[c]);
    brightness += std::fabs(static_cast<double>(result[c]));
  }
  const double distance = 40 * apart / brightness;
  return (1 - std::sqrt(few_samples / samples)) * samples / (samples + distance * distance);
}

float drawn(float result, float mean, double share) {
  return static_cast<float>(result + share * (static_cast<double>(mean) - result));
}

PlainMeans::PlainMeans(const PreparedFrame& prepared, int threads) : prepared_(prepared), threads_(threads) {}

PlainMeans::Part PlainMeans::part_of(int row) const {
  Part part;
  std::vector<double> mean(prepared_.facts.carried);
  for_pixels(prepared_.facts, row, row + 1, [&](std::size_t pixel) {
    if (!has_own_share(prepared_.frame.samples(pixel))) return;
    mean_of_pixel(prepared_.frame, pixel, mean.size(), mean.data());
    part.means.insert(part.means.end(), mean.begin(), mean.end());
    part.effective.push_back(PixelWeights(prepared_.frame, pixel).effective_samples());
  });
  return part;
}

void PlainMeans::add_rows(int first, int end) {
  if (!has_own_share(prepared_.facts.max_samples_per_pixel)) return;
  std::vector<Part> rows(static_cast<std::size_t>(std::max(end - first, 0)));
  Workers(threads_).for_all(
      0, rows.size(), [&](std::size_t n, std::size_t /*worker*/) { rows[n] = part_of(first + static_cast<int>(n)); });
  for (const Part& row : rows) {
    all_.means.insert(all_.means.end(), row.means.begin(), row.means.end());
    all_.effective.insert(all_.effective.end(), row.effective.begin(), row.effective.end());
  }
}

void PlainMeans::draw_to_means(Pixels& pixels, float exposure) const {
  const std::size_t carried = prepared_.facts.carried;
  const float* mean = all_.means.data();
  const double* samples = all_.effective.data();
  for_pixels(prepared_.facts, 0, prepared_.facts.height, [&](std::size_t pixel) {
    if (!has_own_share(prepared_.frame.samples(pixel))) return;
    float* result = pixels.data() + pixel * carried;
    const double share = own_share(*samples++, result, mean, exposure);
    for (std::size_t c = 0; c < carried; ++c) result[c] = drawn(result[c], mean[c], share);
    mean += carried;
  });
}

}  // namespace rpf
