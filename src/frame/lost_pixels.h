// Pixels none of whose samples has a color that can be used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/clean.h"
#include "rpf/samples.h"

namespace rpf {

/// Of the samples begin .. end - 1.
ColorSum sum_of_colors(const SampleBuffer& rows, const Columns& columns, std::uint32_t begin, std::uint32_t end);
PixelColor mean_of(const ColorSum& sum);

/// Gives the lost pixels (ascending) a color: the mean of the eight neighbors' where one of them has a color, else what
/// these got the same way, from the border of a hole to its middle. Returns false and changes nothing where no pixel of
/// the frame has a color. `colors`: [pixel]; those of lost pixels are not known.
bool find_lost_colors(const Window& data_window, const std::vector<PixelColor>& colors, std::vector<LostPixel>& lost);

}  // namespace rpf
