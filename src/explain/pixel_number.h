// A pixel that the user names, as its number in the frame.
#pragma once

#include <cstdint>

#include "rpf/explain.h"

namespace rpf {

/// Throws Error(usage) where it lies outside the data window, Error(input) where it has no samples.
std::uint32_t pixel_number(const PixelPosition& pixel, const SampleBuffer& samples);

}  // namespace rpf
