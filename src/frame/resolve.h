// From samples to pixels: the last step of the filter.
#pragma once

#include <vector>

#include "frame/frame.h"

namespace rpf {

/// The mean of every pixel's samples, weighted where the frame has weights: [pixel][carried], 0 where there are no
/// samples. `colors`: [sample][carried], scaled radiance.
std::vector<float> resolve(const Frame& frame, const std::vector<float>& colors, std::size_t carried);

}  // namespace rpf
