// Scratch memory of the work-items; frame.cl has what the arrays are for.
#pragma once

#include "opencl/session.h"
#include "plan/plan.h"

namespace rpf {

/// Sizes of one work-item's scratch, in elements of the arrays of Slot in frame.cl.
struct ScratchSizes {
  static constexpr std::size_t word_bytes = 4, vector_bytes = 64;

  std::uint32_t capacity = 1;      ///< neighbors
  std::uint32_t most_samples = 1;  ///< own samples
  std::size_t records = 0, planes = 1, columns = 0, sums = 0;

  explicit ScratchSizes(const Plan& plan);
  std::uint64_t bytes() const;
};

struct Scratch {
  ScratchSizes sizes;
  cl::Buffer candidates, neighbors, records, planes, columns, sums;

  Scratch(Session& session, const Plan& plan, std::size_t items);
};

}  // namespace rpf
