#include "cli/environment.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include "cli/numbers.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf::cli {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// A number of threads from the environment, 0 where the variable is not set.
int threads_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == 0) return 0;
  const std::string refusal = refusal_of(text, ranges::threads, variable);
  if (!refusal.empty()) throw Error(ErrorKind::usage, refusal + ", or --threads beside it");
  return std::atoi(text);
}

std::uint64_t machine_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

/// The limit of the control group (version 2), where there is one.
std::uint64_t group_memory() {
  std::uint64_t bytes = 0;
  std::ifstream file("/sys/fs/cgroup/memory.max");
  return file >> bytes ? bytes : unlimited;
}

std::uint64_t address_space() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : unlimited;
}

}  // namespace

int default_threads() {
  for (const char* variable : {"SLURM_CPUS_PER_TASK", "CUE_THREADS"})
    if (const int threads = threads_in(variable)) return threads;
  return available_threads();
}

std::uint64_t default_memory_limit() { return std::min({machine_memory(), group_memory(), address_space()}) / 10 * 9; }

}  // namespace rpf::cli
