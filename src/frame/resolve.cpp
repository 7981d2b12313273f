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
  return resolve_rows(frame, colors, carried, 0, frame.height);
}

std::vector<float> resolve_rows(const Frame& frame, const std::vector<float>& colors, std::size_t carried,
                                int first_row, int end_row) {
  const std::size_t width = static_cast<std::size_t>(frame.width);
  const std::size_t first = static_cast<std::size_t>(first_row) * width,
                    end = static_cast<std::size_t>(end_row) * width;
  std::vector<float> image((end - first) * carried, 0.0F);
  for (std::size_t pixel = first; pixel < end; ++pixel)
    if (frame.samples(pixel) > 0)
      mean_of_samples(frame, pixel, colors, carried, image.data() + (pixel - first) * carried);
  return image;
}

PixelWeights::PixelWeights(const Frame& frame, std::size_t pixel)
    : frame_(frame), is_weighted_(!frame.weights.empty()) {
  for (std::uint32_t i = frame.first_sample[pixel]; is_weighted_ && i < frame.first_sample[pixel + 1]; ++i) {
    const double weight = frame.weight(i);
    total_ += weight;
    squares_ += weight * weight;
  }
  is_weighted_ = total_ > 0;
  if (!is_weighted_) total_ = squares_ = frame.samples(pixel);
}

void mean_of_pixel(const Frame& frame, std::size_t pixel, std::size_t carried, double* mean) {
  const PixelWeights weights(frame, pixel);
  std::fill_n(mean, carried, 0.0);
  for (std::uint32_t i = frame.first_sample[pixel]; i < frame.first_sample[pixel + 1]; ++i) {
    const float *color = frame.record(i), *other = frame.others.data() + (i - frame.first_record) * (carried - 3);
    const double weight = weights.of(i);
    for (std::size_t c = 0; c < carried; ++c) mean[c] += weight * (c < 3 ? color[c] : other[c - 3]);
  }
  for (std::size_t c = 0; weights.total() > 0 && c < carried; ++c) mean[c] /= weights.total();
}

std::array<double, 3> mean_color(const Frame& frame, std::size_t pixel) {
  std::array<double, 3> mean{};
  mean_of_pixel(frame, pixel, 3, mean.data());
  return mean;
}

double energy_of_means(const Frame& frame, const Window& region) {
  double sum = 0;
  for (int y = region.y; y < region.y + region.height; ++y) {
    double of_row = 0;
    for (int x = region.x; x < region.x + region.width; ++x) {
      const std::array<double, 3> mean = mean_color(
          frame, static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x));
      of_row += mean[0] + mean[1] + mean[2];
    }
    sum += of_row;
  }
  return sum;
}

}  // namespace rpf
