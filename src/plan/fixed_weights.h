// The methods whose weights are fixed (algorithm.md, section 8): what makes a Gaussian, bilateral or cross-bilateral
// filter of a plan. All are one filter: a Gaussian of the distance in a space of film position, color and features.
#pragma once

#include "plan/plan.h"

namespace rpf {

/// Plan::centers: the mean of a feature, 0 for color and position; empty for rpf.
std::vector<float> centers_of(const FrameFacts& facts, const Settings& settings);

/// The coordinates of a pass, and the size of its largest neighborhood: the box, whatever is in it.
void plan_fixed_weights(const FrameFacts& facts, const Settings& settings, PassPlan& pass);

}  // namespace rpf
