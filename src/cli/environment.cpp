#include "cli/environment.h"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf::cli {
namespace {

/// A positive number from the environment, 0 where the variable is not set.
int positive_number(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == 0) return 0;
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (*end == 0 && value > 0 && value <= 1 << 20) return static_cast<int>(value);
  throw Error(ErrorKind::usage,
              fmt::format("environment variable {}='{}': a positive number is expected", variable, text));
}

}  // namespace

int default_threads() {
  for (const char* variable : {"SLURM_CPUS_PER_TASK", "CUE_THREADS"})
    if (const int threads = positive_number(variable)) return threads;
  return available_threads();
}

std::uint64_t memory_limit(std::uint64_t megabytes) {
  constexpr std::uint64_t megabyte = 1 << 20, most = std::numeric_limits<std::uint64_t>::max();
  if (megabytes == 0) return available_memory() / 10 * 9;
  return megabytes > most / megabyte ? most : megabytes * megabyte;
}

}  // namespace rpf::cli
