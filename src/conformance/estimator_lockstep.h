// Reference and device on one frame of the learned estimator, stage by stage.
#pragma once

#include "conformance/cases.h"
#include "conformance/comparison.h"

namespace rpf {

/// Compares all stages over what a case's crop reads, then the crop itself as bands of different height. A stage is
/// computed from the device's own stages before it: the first that differs is the one at fault.
Comparison compare_estimates(const ConformanceCase& c, SampleBuffer samples, const std::string& device, int threads);

}  // namespace rpf
