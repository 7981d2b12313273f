// Methods of the whole frame at once, on the reference and on a device.
#pragma once

#include "conformance/cases.h"
#include "conformance/comparison.h"

namespace rpf {

/// Of a method that filters pixels: compares all planes that the steps leave, and the picture.
Comparison compare_steps(const ConformanceCase& c, SampleBuffer samples, const std::string& device, int threads);

/// Of columns of pixels: compares what the first point takes, and what all take together.
Comparison compare_columns(const ConformanceCase& c, SampleBuffer samples, const std::string& device, int threads);

/// Of the light field: compares what the first view sees, and what all see together.
Comparison compare_views(const ConformanceCase& c, SampleBuffer samples, const std::string& device, int threads);

}  // namespace rpf
