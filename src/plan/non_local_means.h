// Non-local means of two half buffers (algorithm.md, section 9.1), as a plan of steps.
#pragma once

#include "plan/pixel_planning.h"

namespace rpf {

void plan_non_local_means(const Settings& settings, PixelPlanning& planning, PixelPlan& plan);

}  // namespace rpf
