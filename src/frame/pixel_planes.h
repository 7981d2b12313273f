// What methods that filter pixels start from: means and variances of a frame's pixels, plane by plane.
#pragma once

#include <vector>

#include "frame/prepare.h"

namespace rpf {

enum class PixelQuantity {
  mean,              ///< of a carried channel over the pixel's samples
  first_half,        ///< the same over the samples 0, 2, 4, ...
  second_half,       ///< and 1, 3, 5, ...; of a pixel with one sample that one
  half_variance,     ///< of the mean of a half, of a color channel: (9.1) to (9.3)
  mask,              ///< 1 where the pixel has samples, 0 where not
  count,             ///< samples
  first_count,       ///< samples of the first half
  second_count,      ///< of the second half
  variance,          ///< of the mean, of a color channel: (9.1) and (9.2)
  feature,           ///< mean of a feature, a missing value is at the feature's mean over the frame
  feature_variance,  ///< of one sample of a feature: (9.1)
  known,             ///< 1 where the pixel knows each feature of this one's group from some sample, 0 where not
  known_mean,        ///< of a feature over the samples that have it; 0 without any
  least_positive,    ///< of a feature's values above 0 the least; 0 without any
  any_positive,      ///< 1 where it has such a value, 0 where not
  zero
};

struct PixelPlane {
  PixelQuantity quantity = PixelQuantity::mean;
  std::size_t channel = 0;  ///< carried channel, or feature
  double unit = 1;          ///< what a feature is divided by
  double origin = 0;        ///< what is subtracted from it before, of known_mean
};

/// [plane][pixel], with room for so many planes in all; colors in scaled radiance, all 0 where a pixel has no samples.
/// A sample's weight takes part in means, not in variances.
std::vector<float> pixel_planes(const PreparedFrame& prepared, const std::vector<PixelPlane>& planes, std::size_t room);

/// [carried][pixel]: the means of all of them.
std::vector<float> pixel_means(const PreparedFrame& prepared);

}  // namespace rpf
