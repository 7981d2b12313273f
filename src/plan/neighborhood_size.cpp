#include "plan/neighborhood_size.h"

#include <algorithm>
#include <cmath>

#include "rpf_math.h"

namespace rpf {

std::uint32_t NeighborhoodSize::size(std::uint32_t samples) const {
  const std::uint64_t counted = kernel::rpf_group_size(samples);
  const std::uint64_t wanted = grows_with_samples ? box_area * counted / 2 : fixed;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, limit));
}

std::uint32_t NeighborhoodSize::draws(std::uint32_t samples) const {
  return std::max(size(samples), samples) - samples;
}

NeighborhoodSize neighborhood_size(const Settings& settings, int box_width) {
  NeighborhoodSize result;
  result.box_area = static_cast<std::uint32_t>(box_width * box_width);
  result.grows_with_samples = settings.profile == Profile::paper && !settings.samples_factor;
  const double fixed = settings.samples_factor.value_or(0.5) * result.box_area;
  result.fixed = static_cast<std::uint32_t>(std::min<double>(std::floor(fixed), most_neighbors));
  if (settings.max_samples > 0) result.limit = std::min(settings.max_samples, most_neighbors);
  return result;
}

}  // namespace rpf
