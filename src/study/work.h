// How long parts of a study take in proportion to each other. For the progress only.
#pragma once

#include "bench/sweep_plan.h"
#include "rpf/settings.h"

namespace rpf::study {

/// Unit: about a microsecond of CPU time.
double rendering_work(const bench::SweepFrame& frame, int samples_per_pixel);
double filtering_work(const bench::SweepFrame& frame, const Settings& settings);

}  // namespace rpf::study
