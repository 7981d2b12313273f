// Bytes behind every device buffer that no kernel may touch. Debug builds only.
#pragma once

#include <utility>
#include <vector>

#include "opencl/opencl.h"

namespace rpf {

#ifdef NDEBUG
constexpr bool has_canaries = false;
#else
constexpr bool has_canaries = true;
#endif

/// The canaries of a session's buffers.
class Canaries {
 public:
  /// A buffer of `bytes`, with a canary behind them in debug builds.
  cl::Buffer allocate(const cl::Context& context, cl::CommandQueue& queue, cl_mem_flags flags, std::size_t bytes);
  /// Throws Error(internal) where a kernel wrote behind a buffer. Forgets buffers that nobody else holds any more.
  void check(cl::CommandQueue& queue);

 private:
  std::vector<std::pair<cl::Buffer, std::size_t>> guarded_;  ///< with the bytes before the canary
};

}  // namespace rpf
