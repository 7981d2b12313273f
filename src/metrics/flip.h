// LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A difference evaluator for
// alternating images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
#pragma once

#include "metrics/planes.h"

namespace rpf::metrics {

/// The error of every pixel in [0, 1], seen as on a 0.7 m wide display of 3,840 pixels from 0.7 m: 67.02 pixels per
/// degree. `light` is linear sRGB, clamped to [0, 1].
Plane flip_map(const Pair& light);

}  // namespace rpf::metrics
