// How many threads a run has.
#pragma once

#include "rpf/settings.h"

namespace rpf {

/// The threads that the settings stand for: available_threads() where they do not say.
int thread_count(const Settings& settings);

}  // namespace rpf
