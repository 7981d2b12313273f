#include <sched.h>

#include <algorithm>

#include "rpf/filter.h"
#include "run/control_groups.h"

namespace rpf {

int available_threads() {
  cpu_set_t mask;
  const int cores = sched_getaffinity(0, sizeof mask, &mask) == 0 ? CPU_COUNT(&mask) : 1;
  return std::clamp(cores, 1, control_group_threads("/"));
}

}  // namespace rpf
