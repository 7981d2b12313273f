// A method that filters pixels, on the reference and on a device.
#pragma once

#include "conformance/cases.h"
#include "conformance/comparison.h"

namespace rpf {

/// Compares all planes that the steps leave, and the picture.
Comparison compare_steps(const ConformanceCase& c, SampleBuffer samples, const std::string& device, int threads);

}  // namespace rpf
