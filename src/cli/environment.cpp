#include "cli/environment.h"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "cli/numbers.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf::cli {
namespace {

/// A number of threads from the environment, 0 where the variable is not set.
int threads_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == 0) return 0;
  const std::string refusal = refusal_of(text, ranges::threads, variable);
  if (!refusal.empty()) throw Error(ErrorKind::usage, refusal + ", or --threads beside it");
  return std::atoi(text);
}

}  // namespace

int default_threads() {
  for (const char* variable : {"SLURM_CPUS_PER_TASK", "CUE_THREADS"})
    if (const int threads = threads_in(variable)) return threads;
  return available_threads();
}

std::uint64_t memory_limit(std::uint64_t megabytes) {
  constexpr std::uint64_t megabyte = 1 << 20, most = std::numeric_limits<std::uint64_t>::max();
  if (megabytes == 0) return available_memory() / 10 * 9;
  return megabytes > most / megabyte ? most : megabytes * megabyte;
}

}  // namespace rpf::cli
