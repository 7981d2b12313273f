#include "opencl/canaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "rpf/error.h"

namespace rpf {
namespace {

constexpr std::size_t canary_bytes = 64;
constexpr std::uint8_t canary = 0xA5;

}  // namespace

cl::Buffer Canaries::allocate(const cl::Context& context, cl::CommandQueue& queue, cl_mem_flags flags,
                              std::size_t bytes) {
  if (!has_canaries) return {context, flags, bytes};
  // All of the buffer: what a kernel reads before anything wrote it is not 0 by chance.
  const std::vector<std::uint8_t> canaries(bytes + canary_bytes, canary);
  cl::Buffer buffer(context, flags, canaries.size());
  queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, canaries.size(), canaries.data());
  guarded_.push_back({buffer, bytes});
  return buffer;
}

void Canaries::check(cl::CommandQueue& queue) {
  const auto is_ours_alone = [](const auto& guarded) {
    return guarded.first.template getInfo<CL_MEM_REFERENCE_COUNT>() == 1;
  };
  guarded_.erase(std::remove_if(guarded_.begin(), guarded_.end(), is_ours_alone), guarded_.end());
  for (const auto& [buffer, bytes] : guarded_) {
    std::vector<std::uint8_t> found(canary_bytes);
    queue.enqueueReadBuffer(buffer, CL_TRUE, bytes, canary_bytes, found.data());
    if (std::any_of(found.begin(), found.end(), [](std::uint8_t byte) { return byte != canary; }))
      throw Error(ErrorKind::internal,
                  fmt::format("a kernel wrote behind a buffer of {} bytes; please report it", bytes));
  }
}

}  // namespace rpf
