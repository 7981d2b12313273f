#include "opencl/scratch.h"

#include <algorithm>

#include "rpf_math.h"

namespace rpf {

ScratchSizes::ScratchSizes(const Plan& plan) : most_samples(plan.most_samples) {
  const std::size_t variables = plan.variables.count(), features = plan.variables.feature_names.size();
  const auto bins = 2 * static_cast<kernel::uint>(plan.half_bins) + 1;
  for (const PassPlan& pass : plan.passes) capacity = std::max(capacity, pass.max_neighbors);
  columns = 5 + features + plan.carried + 1;  // RPF_COLUMNS of frame.cl
  if (plan.method == Method::rpf) {
    records = (variables + plan.carried + RPF_LANES - 1) / RPF_LANES * capacity;
    planes = variables * kernel::rpf_plane_words(capacity) * kernel::rpf_bin_vectors(bins);
  } else {
    capacity = (kernel::rpf_blocks(capacity) + 1) * RPF_LANES;  // box.cl copies whole vectors
    records = columns * capacity / RPF_LANES;
  }
  columns *= RPF_STRETCH;
  sums = std::size_t{most_samples} * (1 + plan.carried) + 1;
}

std::uint64_t ScratchSizes::bytes() const {
  return word_bytes * (std::uint64_t{RPF_DRAWN_AT_ONCE} + capacity) +
         vector_bytes * (records + planes + columns + sums);
}

Scratch::Scratch(Session& session, const Plan& plan, std::size_t items) : sizes(plan) {
  constexpr std::size_t word = ScratchSizes::word_bytes, vector = ScratchSizes::vector_bytes;
  candidates = session.buffer(items * RPF_DRAWN_AT_ONCE * word);
  neighbors = session.buffer(items * sizes.capacity * word);
  records = session.buffer(items * sizes.records * vector);
  planes = session.buffer(items * sizes.planes * vector);
  columns = session.buffer(items * sizes.columns * vector);
  sums = session.buffer(items * sizes.sums * vector);
}

}  // namespace rpf
