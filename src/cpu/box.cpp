#include "cpu/box.h"

#include <algorithm>

#include "plan/box.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Samples first .. last - 1.
void append(std::uint32_t first, std::uint32_t last, Neighborhood& n) {
  for (std::uint32_t sample = first; sample < last; ++sample) n.neighbors.push_back(sample);
}

}  // namespace

void gather_box(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, Neighborhood& n) {
  const int reach = box_reach(plan.passes[static_cast<std::size_t>(pass)].box_width);
  const int x = static_cast<int>(pixel) % frame.width, y = static_cast<int>(pixel) / frame.width;
  const int left = std::max(x - reach, 0), right = std::min(x + reach, frame.width - 1);
  const std::vector<std::uint32_t>& first_sample = frame.first_sample;
  n.drawn = 0;
  n.neighbors.clear();
  append(first_sample[pixel], first_sample[pixel + 1], n);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, frame.height - 1); ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * frame.width + left, end = begin + right - left + 1;
    if (row == y) append(first_sample[begin], first_sample[pixel], n);
    append(first_sample[row == y ? pixel + 1 : begin], first_sample[end], n);
  }
}

void filter_box(const Frame& frame, const Plan& plan, int pass, const Neighborhood& n, std::uint32_t own,
                const std::vector<float>& colors, FilterScratch& scratch, float* out, std::vector<float>* weights_out) {
  const std::vector<Coordinate>& coordinates = plan.passes[static_cast<std::size_t>(pass)].coordinates;
  scratch.start(n.size(), coordinates.size());
  for (std::size_t a = 0; a < coordinates.size(); ++a) {
    const auto [variable, scale] = coordinates[a];
    float* column = scratch.coordinates.data() + a * scratch.padded;
    for (std::uint32_t j = 0; j < n.size(); ++j)
      column[j] = kernel::rpf_centered(frame.record(n.neighbors[j])[variable], plan.centers[variable]) * scale;
  }
  average(plan.carried, n, own, colors, scratch, out, weights_out);
}

}  // namespace rpf
