// What the learned estimator is shown of a frame (docs/network.md, "Frame facts" and "Inputs of a sample").
#pragma once

#include <memory>

#include "frame/prepare.h"
#include "learned/estimate_plan.h"
#include "learned/observe_scan.h"

namespace rpf {

struct Observed {
  PreparedFrame prepared;  ///< its records as in estimate_plan.h; variables: names of what varies
  EstimatePlan plan;
  double energy = 0;  ///< ObservedFindings::energy of the scaled radiance
};

/// Prepares a frame for the learned estimator: makes what the network sees in the place of the samples, and plans for
/// it.
Observed observe(SampleBuffer samples, const Settings& settings, std::shared_ptr<const Network> network);

/// What is known of a frame without its samples.
Observed observe_frame(const SampleBuffer& frame, const ObservedFindings& found, const Settings& settings,
                       std::shared_ptr<const Network> network);

/// Fills in what is known of some rows, or all, that were cleaned: records, weights, what is carried beside the color.
/// Returns first_sample of these rows.
std::vector<std::uint32_t> observe_rows(SampleBuffer rows, const SampleBuffer& frame, const ObservedFindings& found,
                                        const Settings& settings, const EstimatePlan& plan, PreparedFrame& prepared);

}  // namespace rpf
