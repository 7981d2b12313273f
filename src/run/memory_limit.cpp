#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "rpf/filter.h"
#include "run/control_groups.h"

namespace rpf {
namespace {

std::uint64_t machine_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

std::uint64_t resource_limit(int kind) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(kind), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? limit.rlim_cur
             : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::uint64_t available_memory() {
  return std::min(
      {machine_memory(), control_group_memory("/"), resource_limit(RLIMIT_AS), resource_limit(RLIMIT_DATA)});
}

}  // namespace rpf
