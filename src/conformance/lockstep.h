// Reference and device on one frame, pass by pass.
#pragma once

#include "conformance/cases.h"
#include "rpf/conformance.h"

namespace rpf {

/// Runs a case on both backends: in every pass the traces of some pixels are compared, then all colors and statistics.
/// Both start each pass from the same state, so a stage that differs is the one at fault. Throws Error(device).
CaseResult run_in_lockstep(const ConformanceCase& c, const std::string& device, int threads);

}  // namespace rpf
