// Scratch memory of the work-items; frame.cl has what the arrays are for.
#pragma once

#include "opencl/session.h"
#include "plan.h"

namespace rpf {

/// Sizes of one work-item's scratch, in elements of the arrays of Slot in frame.cl.
struct ScratchSizes {
  std::uint32_t capacity = 0;  ///< neighbors, a multiple of RPF_LANES
  std::size_t column_floats = 0, plane_words = 0, color_floats = 0;

  explicit ScratchSizes(const Plan& plan);
  std::uint64_t bytes() const;
};

struct Scratch {
  ScratchSizes sizes;
  cl::Buffer candidates, neighbors, columns, planes, colors;

  Scratch(Session& session, const Plan& plan, std::size_t items);
};

}  // namespace rpf
