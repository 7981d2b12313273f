// A cross-bilateral filter that Stein's unbiased risk chooses the width of, pixel by pixel (algorithm.md, section 9.3),
// as a plan of steps.
#pragma once

#include "plan/pixel_planning.h"

namespace rpf {

/// Throws Error(usage) for more features than a step can hold.
void plan_stein_risk(PixelPlanning& planning, PixelPlan& plan);

}  // namespace rpf
