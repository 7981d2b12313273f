// How many threads a run has.
#pragma once

#include "rpf/filter.h"
#include "rpf/settings.h"

namespace rpf {

/// The threads that the settings stand for: available_threads() where they do not say.
inline int thread_count(const Settings& settings) {
  return settings.threads > 0 ? settings.threads : available_threads();
}

}  // namespace rpf
