// From filtered pixels to images and what is told of them.
#pragma once

#include <vector>

#include "frame/prepare.h"
#include "rpf/filter.h"
#include "rpf/image.h"

namespace rpf {

using Pixels = std::vector<float>;  ///< [pixel][carried], of the frame or of some of its rows

/// Adds R, G and B of the crop's pixels in some rows to a sum, in the order of the frame. `pixels`: of these rows.
void add_energy(const Pixels& pixels, const FrameFacts& facts, int first_row, int end_row, double& sum);

/// Of the whole crop; `pixels` of the frame.
double energy(const Pixels& pixels, const FrameFacts& facts);

/// What is left of the energy: 1 where both are 0.
double share_of_energy(double kept, double plain);

/// Makes the images of a result of the crop of the frame's pixels, undoing the radiance scale. `geometry`: windows and
/// metadata.
void make_images(const Pixels& pixels, const PreparedFrame& prepared, const Image& geometry, Result& result);

}  // namespace rpf
