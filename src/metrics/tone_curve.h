// The stated tone curve of PSNR, SSIM and FLIP: clamp to [0, 1], then the sRGB transfer function.
#pragma once

#include "metrics/planes.h"

namespace rpf::metrics {

/// Light that a display can show: clamped to [0, 1]. NaN stays NaN.
ColorPlanes clamped(const ColorPlanes& color);
/// Clamped, then encoded as sRGB.
ColorPlanes displayed(const ColorPlanes& color);

}  // namespace rpf::metrics
