// Sums of many variables over neighbors, in the shape that numeric.h prescribes.
#pragma once

#include <vector>

#include "numeric.h"

namespace rpf {

/// One rpf_lanes per variable, stored lane by lane so that a neighbor's row is added in one sweep.
class LaneSums {
 public:
  void clear(std::size_t variables) {
    variables_ = variables;
    sums_.assign(RPF_LANES * variables, 0.0F);
  }
  /// Where neighbor j's contributions go: [variable].
  float* lane(std::size_t j) { return sums_.data() + (j % RPF_LANES) * variables_; }

  float total(std::size_t variable) const {
    kernel::rpf_lanes lanes;
    for (std::size_t l = 0; l < RPF_LANES; ++l) lanes.lane[l] = sums_[l * variables_ + variable];
    return kernel::rpf_lanes_total(&lanes);
  }

 private:
  std::size_t variables_ = 0;
  std::vector<float> sums_;
};

}  // namespace rpf
