// In which order rows go through the passes of a plan where only some of them are in memory.
#pragma once

#include <functional>
#include <vector>

#include "plan/plan.h"

namespace rpf {

struct RowRange {
  int first = 0, end = 0;
};

/// Some rows are read, then every pass filters those that it has all of what it reads for: each trails the one before
/// by what it reads around itself.
struct PassStep {
  RowRange rows;                 ///< in memory: those that this step or a later one reads, up to the last one read
  int read_from = 0;             ///< the first one that this step reads anew
  std::vector<RowRange> passes;  ///< what each pass filters
};

/// The steps that filter the region of every pass, in order. `read_end(row)`: the end of the rows that are read at once
/// from this one on.
std::vector<PassStep> steps_of(const Plan& plan, const Window& crop, const std::function<int(int)>& read_end);

}  // namespace rpf
