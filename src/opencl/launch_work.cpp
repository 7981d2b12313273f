#include "opencl/launch_work.h"

#include <algorithm>

namespace rpf {
namespace {

/// A neighbor that is found and measured costs as much as so many weights, a pixel as much as so many neighbors
/// (run/progress_meter.cpp).
constexpr std::uint64_t weights_per_neighbor = 50, neighbors_per_pixel = 100;

std::uint64_t samples_in_box(const Frame& frame, const PassPlan& pass, int x, int y) {
  const int reach = (pass.box_width - 1) / 2;
  const int left = std::max(x - reach, 0), right = std::min(x + reach, frame.width - 1);
  std::uint64_t samples = 0;
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, frame.height - 1); ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * frame.width;
    samples += frame.first_sample[begin + right + 1] - frame.first_sample[begin + left];
  }
  return samples;
}

std::uint64_t neighbors_of(const Frame& frame, const Plan& plan, int pass, int x, int y, std::uint32_t own) {
  const PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  return plan.method == Method::rpf ? std::max(p.neighborhood.size(own), own) : samples_in_box(frame, p, x, y);
}

}  // namespace

PixelWork pixel_work(const Frame& frame, const Plan& plan, int pass, int x, int y) {
  const std::uint32_t own = frame.samples(static_cast<std::size_t>(y) * frame.width + x);
  return own == 0 ? PixelWork{} : PixelWork{own, neighbors_of(frame, plan, pass, x, y, own)};
}

PixelWork most_work(const Frame& frame, const Plan& plan, int pass, const Window& tile) {
  PixelWork most;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const PixelWork pixel = pixel_work(frame, plan, pass, x, y);
      most = {std::max(most.own, pixel.own), std::max(most.neighbors, pixel.neighbors)};
    }
  return most;
}

std::uint64_t work_of(const Frame& frame, const Plan& plan, int pass, const Window& tile) {
  std::uint64_t work = 0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const PixelWork pixel = pixel_work(frame, plan, pass, x, y);
      if (pixel.own > 0) work += pixel.weights() + weights_per_neighbor * (pixel.neighbors + neighbors_per_pixel);
    }
  return work;
}

bool has_long_pixels(const Plan& plan, std::uint64_t weights_at_once) {
  return std::any_of(plan.passes.begin(), plan.passes.end(), [&](const PassPlan& pass) {
    return PixelWork{plan.most_samples, pass.max_neighbors}.weights() > weights_at_once;
  });
}

std::array<Window, 2> halves_of(const Window& tile) {
  const int upper = tile.height / 2, left = tile.width / 2;
  if (upper > 0)
    return {Window{tile.x, tile.y, tile.width, upper}, Window{tile.x, tile.y + upper, tile.width, tile.height - upper}};
  return {Window{tile.x, tile.y, left, tile.height}, Window{tile.x + left, tile.y, tile.width - left, tile.height}};
}

}  // namespace rpf
