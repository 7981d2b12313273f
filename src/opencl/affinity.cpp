#include "opencl/affinity.h"

#include <sched.h>
#include <unistd.h>

#include <cstdlib>

namespace rpf {
namespace {

/// Whether this process may run on all processors, and these are numbered without gaps.
bool has_all_processors() {
  cpu_set_t allowed;
  const long online = ::sysconf(_SC_NPROCESSORS_ONLN);
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0 || CPU_COUNT(&allowed) != online) return false;
  for (long i = 0; i < online; ++i)
    if (!CPU_ISSET(static_cast<std::size_t>(i), &allowed)) return false;
  return true;
}

}  // namespace

void keep_driver_threads_apart() {
  if (has_all_processors()) ::setenv("POCL_AFFINITY", "1", 0);
}

}  // namespace rpf
