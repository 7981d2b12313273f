// What a backend is handed at once: parts of a pass's region.
#pragma once

#include <vector>

#include "plan/plan.h"
#include "rpf/filter.h"

namespace rpf {

/// The tiles of a part of a pass's region, in their order.
std::vector<Window> cut_into_tiles(const Plan& plan, int pass, const Window& part, const Control& control, int threads);

}  // namespace rpf
