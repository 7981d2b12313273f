#pragma once

#include <cstdint>

namespace rpf::cli {

/// Threads to use when --threads is not given: RPF_NUM_THREADS (read by the parser), then the scheduler's
/// SLURM_CPUS_PER_TASK or CUE_THREADS, then the affinity mask.
int default_threads();

/// Bytes that a run may take: --max-memory in megabytes, for which the parser reads RPF_MAX_MEMORY_MB too; where that
/// is 0, because neither is given, nine tenths of available_memory().
std::uint64_t memory_limit(std::uint64_t megabytes);

}  // namespace rpf::cli
