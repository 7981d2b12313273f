// What the learned estimator is shown of a frame (docs/network.md, "Frame facts" and "Inputs of a sample").
#pragma once

#include <memory>

#include "frame/prepare.h"
#include "learned/estimate_plan.h"

namespace rpf {

/// Replaces the records of a prepared frame, in place, by what the network sees (estimate_plan.h), and plans for it.
/// The names of what does not vary go from the frame's variables to `dropped`.
EstimatePlan observe(PreparedFrame& prepared, std::shared_ptr<const Network> network);

/// The power of two that exposes the frame: of the mean luminance, without what is far above the median. Over all
/// samples, in the order of the pixels.
float exposure_of(const Frame& frame);

/// Of the positions of the first sample of every pixel that has one.
struct PositionFacts {
  double median[3] = {};  ///< lower median of each component
  double deviation = 1;   ///< mean absolute deviation from it, over the components too; 1 where all are one
};

}  // namespace rpf
