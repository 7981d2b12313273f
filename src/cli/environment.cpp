#include "cli/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "cli/numbers.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf::cli {
namespace {

/// A whole number from the environment, 0 where the variable is not set. `option`: what says the same.
std::uint64_t number_in(const char* variable, const NumberRange& range, const char* option) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == 0) return 0;
  const std::string refusal = refusal_of(text, range, variable);
  if (!refusal.empty()) throw Error(ErrorKind::usage, fmt::format("{}, or {} beside it", refusal, option));
  return std::strtoull(text, nullptr, 10);
}

constexpr std::uint64_t megabyte = 1 << 20;

/// What the scheduler lets this job have, in bytes; the largest number without one. Slurm's 0 is all of the machine.
std::uint64_t scheduled_memory() {
  constexpr NumberRange slurm{0, 1 << 30, "8000", true}, cue{1, 1e12, "8000000", true};
  if (const std::uint64_t megabytes = number_in("SLURM_MEM_PER_NODE", slurm, "--max-memory"))
    return megabytes * megabyte;
  if (const std::uint64_t kilobytes = number_in("CUE_MEMORY", cue, "--max-memory")) return kilobytes * 1024;
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::string quoted_with_source(const std::string& text, const std::string& variable) {
  const char* value = variable.empty() ? nullptr : std::getenv(variable.c_str());
  return fmt::format("{}'{}'", value != nullptr && text == value ? variable + "=" : "", text.substr(0, 40));
}

int default_threads() {
  for (const char* variable : {"SLURM_CPUS_PER_TASK", "CUE_THREADS", "NSLOTS"})
    if (const std::uint64_t threads = number_in(variable, ranges::threads, "--threads"))
      return static_cast<int>(threads);
  return available_threads();
}

std::uint64_t memory_limit(std::uint64_t megabytes) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  if (megabytes == 0) return std::min(available_memory(), scheduled_memory()) / 10 * 9;
  return megabytes > most / megabyte ? most : megabytes * megabyte;
}

}  // namespace rpf::cli
