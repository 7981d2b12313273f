#pragma once

#include <cstdint>

namespace rpf::cli {

/// Threads to use when --threads is not given: RPF_NUM_THREADS (read by the parser), then the scheduler's
/// SLURM_CPUS_PER_TASK or CUE_THREADS, then the affinity mask.
int default_threads();

/// Bytes that a run may take when --max-memory is not given: nine tenths of what the machine, the control group or
/// `ulimit -v` allow, whichever is least.
std::uint64_t default_memory_limit();

}  // namespace rpf::cli
