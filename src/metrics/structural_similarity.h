// SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity",
// IEEE TIP 13(4), 2004.
#pragma once

#include "metrics/planes.h"

namespace rpf::metrics {

/// Mean over all pixels whose 11x11 window lies inside the image, and over R, G, B. `shown` has gone through the tone
/// curve. NaN where no pixel has such a window.
double structural_similarity(const Pair& shown);

}  // namespace rpf::metrics
