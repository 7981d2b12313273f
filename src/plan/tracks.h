// How what samples saw moves while the shutter is open (algorithm.md, section 11).
#pragma once

#include <array>
#include <vector>

#include "frame/prepare.h"

namespace rpf {

/// Where positions are counted from, so that float has digits for where they differ.
std::array<double, 3> middle_of_positions(const FrameFacts& facts);

/// [sample][RPF_TRACK]: (11.1) from the origin on; of a ray that left the scene its place on the film. A sample without
/// a weight is nowhere: NaN.
std::vector<float> sample_tracks(const PreparedFrame& prepared, const std::array<double, 3>& origin);

}  // namespace rpf
