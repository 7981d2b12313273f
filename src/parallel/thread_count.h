// How many threads a run has.
#pragma once

#include "rpf/filter.h"
#include "rpf/settings.h"

namespace rpf {

/// What a wish for so many threads stands for: available_threads() for none.
inline int thread_count(int wanted) { return wanted > 0 ? wanted : available_threads(); }
inline int thread_count(const Settings& settings) { return thread_count(settings.threads); }

}  // namespace rpf
