// Memory is accounted for before it is taken.
#pragma once

#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// Throws Error(memory) with the need and the limit where the run would exceed Settings::max_memory.
void check_memory(const SampleBuffer& samples, const Settings& settings);

}  // namespace rpf
