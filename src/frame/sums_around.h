// Sums over squares of pixels.
#pragma once

#include <vector>

namespace rpf {

/// Of a plane [height][width], at every pixel: the sum over the pixels within `reach` to each side, as far as the
/// picture goes.
std::vector<double> sums_around(const std::vector<double>& plane, int width, int height, int reach);

}  // namespace rpf
