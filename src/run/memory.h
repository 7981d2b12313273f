// Memory is accounted for before it is taken.
#pragma once

#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// Throws Error(memory) with the need and the limit where the run, with `more` bytes for what else the
/// caller does, would exceed Settings::max_memory.
void check_memory(const SampleBuffer& samples, const Settings& settings, std::uint64_t more = 0);

}  // namespace rpf
