#include "opencl/scratch.h"

#include <algorithm>

#include "rpf_math.h"

namespace rpf {

ScratchSizes::ScratchSizes(const Plan& plan) {
  std::uint32_t neighbors = 1;
  for (const PassPlan& pass : plan.passes) neighbors = std::max(neighbors, pass.max_neighbors);
  const std::uint32_t blocks = kernel::rpf_blocks(neighbors);
  const std::size_t variables = plan.variables.count(), bins = 2 * static_cast<std::size_t>(plan.half_bins) + 1;
  capacity = blocks * RPF_LANES;
  if (plan.method != Method::rpf) capacity += RPF_LANES;  // box.cl copies whole vectors
  column_floats = variables * capacity;
  plane_words = plan.method != Method::rpf ? 1 : variables * bins * ((blocks + 31) / 32 * RPF_LANES);
  color_floats = plan.carried * capacity;
}

std::uint64_t ScratchSizes::bytes() const {
  constexpr std::uint64_t word = 4;
  return word * (2 * std::uint64_t{capacity} + column_floats + plane_words + color_floats);
}

Scratch::Scratch(Session& session, const Plan& plan, std::size_t items) : sizes(plan) {
  constexpr std::size_t word = 4;
  candidates = session.buffer(items * sizes.capacity * word);
  neighbors = session.buffer(items * sizes.capacity * word);
  columns = session.buffer(items * sizes.column_floats * word);
  planes = session.buffer(items * sizes.plane_words * word);
  colors = session.buffer(items * sizes.color_floats * word);
}

}  // namespace rpf
