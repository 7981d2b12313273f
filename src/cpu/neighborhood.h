// Section 3: which samples a pixel is filtered with.
#pragma once

#include <cstdint>
#include <vector>

#include "cpu/lane_sums.h"
#include "frame/frame.h"
#include "plan/plan.h"

namespace rpf {

/// Scratch that a thread reuses from pixel to pixel. N neighbors, V variables, m features.
struct Neighborhood {
  std::vector<std::uint32_t> candidates;                  ///< samples drawn, the latest portion
  std::uint32_t drawn = 0;                                ///< samples drawn in all
  std::vector<std::uint32_t> neighbors;                   ///< [N] samples; the pixel's own come first
  std::vector<float> shift;                               ///< [V] of the first neighbor that has it, else 0
  std::vector<float> rows;                                ///< [N][V] values less the shift; normalize() works in place
  std::vector<float> own_mean, own_deviation, tolerance;  ///< [m]
  LaneSums sums;

  std::uint32_t size() const { return static_cast<std::uint32_t>(neighbors.size()); }
};

/// Fills `n` for a pixel that has samples.
void gather(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, Neighborhood& n);

}  // namespace rpf
