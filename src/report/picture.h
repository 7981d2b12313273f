#pragma once

#include <optional>
#include <vector>

#include "rpf/image.h"

namespace rpf::report {

/// White pixels between what stands side by side.
constexpr int picture_gap = 8;

/// An image of R, G and B, all of one value.
Image plain_picture(int width, int height, float value);

/// R, G and B of images of equal size in a row, with gaps of white pixels: small ones enlarged by whole pixels, large
/// ones averaged over squares of whole pixels, so that the row is not much wider than 4,000 pixels. With a crop, it is
/// outlined in each, and below each stands its crop, enlarged by whole pixels to at most the width and twice the height
/// above it. The crop counts from the image's first pixel and lies inside the image.
Image side_by_side(const std::vector<Image>& images, const std::optional<Window>& crop = {});

/// The part of a quarter of the image's width and a quarter of its height that holds the most error, the topmost, then
/// the leftmost of equal ones; counts from the first pixel. `errors` has one channel. A pixel counts at most 1, or one
/// firefly would decide; NaN counts 1.
Window worst_crop(const Image& errors);

}  // namespace rpf::report
