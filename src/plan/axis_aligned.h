// Soft shadows, filtered as wide as their occluders allow (algorithm.md, section 9.4), as a plan of steps.
#pragma once

#include "plan/pixel_planning.h"

namespace rpf {

void plan_axis_aligned(const Settings& settings, PixelPlanning& planning, PixelPlan& plan);

}  // namespace rpf
