// Which pixels each pass filters, so that the wanted ones are those of the whole image: what boxes read.
#pragma once

#include "plan/plan.h"

namespace rpf {

/// The last pass filters the crop; each pass before it also what the next one reads around its own region.
void plan_regions(Plan& plan, const Window& crop);

}  // namespace rpf
