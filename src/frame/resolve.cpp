#include "frame/resolve.h"

#include <algorithm>

#include "rpf_math.h"

namespace rpf {
namespace {

/// Weighted mean of a pixel's samples; the plain mean where no sample has a weight.
void mean_of_samples(const Frame& frame, std::size_t pixel, const std::vector<float>& colors, std::size_t carried,
                     float* out) {
  const std::uint32_t first = frame.first_sample[pixel], samples = frame.samples(pixel);
  const auto is_weighted = [&](float w) { return w > 0; };
  const bool weighted = !frame.weights.empty() && std::any_of(frame.weights.begin() + first,
                                                              frame.weights.begin() + first + samples, is_weighted);
  kernel::rpf_lanes weight_sum;
  kernel::rpf_lanes_clear(&weight_sum);
  for (std::uint32_t i = 0; i < samples; ++i)
    kernel::rpf_lanes_add(&weight_sum, i, weighted ? frame.weights[first + i] : 1.0F);
  for (std::size_t c = 0; c < carried; ++c) {
    kernel::rpf_lanes sum;
    kernel::rpf_lanes_clear(&sum);
    float smallest = colors[first * carried + c], largest = smallest;
    for (std::uint32_t i = 0; i < samples; ++i) {
      const float color = colors[(first + i) * carried + c];
      smallest = std::min(smallest, color);
      largest = std::max(largest, color);
      kernel::rpf_lanes_add(&sum, i, weighted ? color * frame.weights[first + i] : color);
    }
    out[c] =
        kernel::rpf_filtered(kernel::rpf_lanes_total(&sum), kernel::rpf_lanes_total(&weight_sum), smallest, largest);
  }
}

}  // namespace

std::vector<float> resolve(const Frame& frame, const std::vector<float>& colors, std::size_t carried) {
  const std::size_t pixels = frame.first_sample.size() - 1;
  std::vector<float> image(pixels * carried, 0.0F);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    if (frame.samples(pixel) > 0) mean_of_samples(frame, pixel, colors, carried, image.data() + pixel * carried);
  return image;
}

}  // namespace rpf
