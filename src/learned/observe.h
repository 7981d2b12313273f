// What the learned estimator is shown of a frame (docs/network.md, "Frame facts" and "Inputs of a sample").
#pragma once

#include <memory>

#include "frame/prepare.h"
#include "learned/estimate_plan.h"

namespace rpf {

struct Observed {
  PreparedFrame prepared;  ///< its records as in estimate_plan.h; variables: names of what varies
  EstimatePlan plan;
};

/// Prepares a frame for the learned estimator: makes what the network sees in the place of the samples, and plans for
/// it.
Observed observe(SampleBuffer samples, const Settings& settings, std::shared_ptr<const Network> network);

/// Of the positions of the first sample of every pixel that has one.
struct PositionFacts {
  double median[3] = {};  ///< lower median of each component
  double deviation = 1;   ///< mean absolute deviation from it, over the components too; 1 where all are one
};

}  // namespace rpf
