// Gaussians whose width is chosen pixel by pixel (algorithm.md, section 9.2), as a plan of steps.
#pragma once

#include "plan/pixel_planning.h"

namespace rpf {

void plan_gaussian_bank(const Settings& settings, PixelPlanning& planning, PixelPlan& plan);

}  // namespace rpf
