// What a report says of a pass.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "plan/plan.h"
#include "rpf/filter.h"
#include "seam/backend.h"

namespace rpf {

/// Means over the pixels of a pass, which are added in the order of the frame, so that what is told does not depend on
/// threads, tiles or how many rows are in memory.
class PassSummary {
 public:
  /// Adds the pixels of a part of the pass's region: rows below those before. `statistics`: of the frame.
  void add(const std::vector<PixelStatistics>& statistics, const Frame& frame, const Window& part);
  /// Energy and seconds are the caller's.
  PassReport report(const PassPlan& pass) const;

 private:
  double pixels_ = 0, accepted_ = 0, drawn_ = 0;
  double neighbors_ = 0, fraction_random_ = 0, alpha_ = 0, beta_ = 0;
};

/// Of a whole pass.
PassReport summarize(const std::vector<PixelStatistics>& statistics, const Frame& frame, const PassPlan& pass);

}  // namespace rpf
