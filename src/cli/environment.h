#pragma once

#include <cstdint>
#include <string>

namespace rpf::cli {

/// Threads to use when --threads is not given: RPF_NUM_THREADS (read by the parser), then the scheduler's
/// SLURM_CPUS_PER_TASK, CUE_THREADS or NSLOTS, then available_threads().
int default_threads();

/// Bytes that a run may take: --max-memory in megabytes (or RPF_MAX_MEMORY_MB); where that is 0, nine tenths of
/// available_memory() or of the scheduler's SLURM_MEM_PER_NODE (megabytes) or CUE_MEMORY (kilobytes), if less.
std::uint64_t memory_limit(std::uint64_t megabytes);

/// 'text', or VARIABLE='text' where this variable of the environment holds just that; at most 40 bytes of it.
std::string quoted_with_source(const std::string& text, const std::string& variable);

}  // namespace rpf::cli
