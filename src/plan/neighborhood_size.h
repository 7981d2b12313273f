// How many samples a neighborhood asks for: M of algorithm.md, section 3.
#pragma once

#include <cstdint>

#include "rpf/settings.h"

namespace rpf {

/// The largest M and the largest number of samples a pixel: counters, tables and float counts stay exact below it.
constexpr std::uint32_t most_neighbors = 1U << 24;

/// M, for any number of own samples.
struct NeighborhoodSize {
  std::uint32_t box_area = 1;       ///< b^2
  bool grows_with_samples = false;  ///< M = b^2 min(s, RPF_GROUP) / 2 (paper) instead of `fixed`
  std::uint32_t fixed = 0;          ///< M otherwise
  std::uint32_t limit = most_neighbors;

  std::uint32_t size(std::uint32_t samples) const;
  /// Candidates to draw for a pixel with so many samples of its own: M - s, not below 0.
  std::uint32_t draws(std::uint32_t samples) const;
};

/// The neighborhood size of one pass.
NeighborhoodSize neighborhood_size(const Settings& settings, int box_width);

}  // namespace rpf
