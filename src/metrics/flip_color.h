// The color spaces of FLIP, relative to the white of sRGB (D65).
#pragma once

#include <array>

namespace rpf::metrics {

using Triple = std::array<double, 3>;

/// Linear sRGB to YCxCz, the linear opponent space in which the eye's blur is applied, and back.
Triple opponent_of(const Triple& rgb);
Triple rgb_of(const Triple& opponent);

/// Linear sRGB to CIE L*a*b* with the Hunt effect: a* and b* times L* / 100.
Triple hunt_lab_of(const Triple& rgb);
/// |dL| + the Euclidean distance of a and b (HyAB), to the power 0.7.
double hyab_distance(const Triple& a, const Triple& b);

}  // namespace rpf::metrics
