// Pixels none of whose samples has a color that can be used.
#pragma once

#include <cstddef>
#include <vector>

#include "frame/clean.h"
#include "rpf/samples.h"

namespace rpf {

/// Gives all samples of the lost pixels (ascending) one color: the mean of the eight neighbors' where one of them has
/// a color, else what these got the same way, from the border of a hole to its middle. Returns false and changes
/// nothing where no pixel of the frame has a color.
bool fill_lost_pixels(SampleBuffer& samples, const Columns& columns, const std::vector<std::size_t>& lost);

}  // namespace rpf
