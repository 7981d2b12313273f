// HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021 (short papers).
#pragma once

#include "metrics/planes.h"

namespace rpf::metrics {

/// The exposures at which two images are compared, in stops: light is multiplied by 2^exposure.
struct ExposureRange {
  double first = 0;  ///< shows the brightest pixel of the reference at 0.85 of white
  double last = 0;   ///< ... its median; at least `first`
  int count = 2;     ///< evenly spaced, both ends included, at most one stop apart but for two exposures
};

/// From the luminance of the reference, linear sRGB. What is not finite is left out.
ExposureRange exposure_range(const ColorPlanes& reference);

/// The largest LDR-FLIP (flip.h) of every pixel over these exposures, behind the ACES tone curve (Narkowicz's fit),
/// in [0, 1]. Negative light counts as 0. `light` is linear sRGB, not clamped.
Plane hdr_flip_map(const Pair& light);

}  // namespace rpf::metrics
