// Gaussian means over pixels.
#pragma once

#include <vector>

namespace rpf {

/// Replaces every value of a plane [height][width] by the sum of the values around it, weighted by a Gaussian whose
/// standard deviation is `sigma` pixels. Outside is 0: divide by a blurred plane of counts to have means.
void blur(std::vector<float>& plane, int width, int height, float sigma);

}  // namespace rpf
