// A pixel that the user names, as its number in the frame.
#pragma once

#include <cstdint>
#include <vector>

#include "rpf/explain.h"

namespace rpf {

/// Throws Error(usage) where it lies outside the data window, Error(input) where it has no samples.
std::uint32_t pixel_number(const PixelPosition& pixel, const SampleBuffer& samples);

/// Throws Error(input) where the pixel with this number has no samples, as `first_sample` counts them: in a frame that
/// was prepared, those that can be used.
void check_has_samples(const PixelPosition& pixel, std::uint32_t number,
                       const std::vector<std::uint32_t>& first_sample);

}  // namespace rpf
