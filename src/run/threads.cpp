#include "run/threads.h"

#include <sched.h>

#include "rpf/filter.h"

namespace rpf {

int available_threads() {
  cpu_set_t mask;
  return sched_getaffinity(0, sizeof mask, &mask) == 0 && CPU_COUNT(&mask) > 0 ? CPU_COUNT(&mask) : 1;
}

int thread_count(const Settings& settings) { return settings.threads > 0 ? settings.threads : available_threads(); }

}  // namespace rpf
