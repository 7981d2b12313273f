// Errors between images.
#pragma once

#include "rpf/image.h"

namespace rpf {

/// Errors of an image against its reference over R, G and B of all pixels.
struct ImageError {
  double mse = 0;     ///< mean of (a - b)^2
  double relmse = 0;  ///< mean of (a - b)^2 / (b^2 + 0.01)
  double energy = 0;  ///< sum of a / sum of b
};

/// Compares the R, G, B channels by name. Throws Error(input) where sizes differ or a channel is missing.
ImageError compare_images(const Image& image, const Image& reference);

}  // namespace rpf
