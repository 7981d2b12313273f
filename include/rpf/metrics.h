// Errors between images. docs/commands.md has every definition as a formula.
#pragma once

#include <array>
#include <cstdint>

#include "rpf/image.h"

namespace rpf {

/// Where one channel of an image is farthest from its reference. NaN counts as farther than any number.
struct LargestDifference {
  double difference = 0;  ///< |a - b|, linear radiance
  int x = 0, y = 0;       ///< the first such pixel, in the reference's coordinates
};

/// In relMSE, (a - b)^2 / (b^2 + floor), keeps black pixels of the reference b from deciding alone; the unit is that of
/// radiance squared.
constexpr double relmse_floor = 0.01;

/// Errors of an image a against its reference b, over R, G and B of all pixels. The first block is about linear
/// radiance; the second about what a display shows: both images clamped to [0, 1], then the sRGB transfer function;
/// the third about what it shows of them at any exposure, behind the ACES tone curve.
/// A NaN in the image or its reference makes every mean that includes it NaN.
struct ImageError {
  double mse = 0;             ///< mean of (a - b)^2; 0 is best
  double relmse = 0;          ///< mean of (a - b)^2 / (b^2 + 0.01), each channel value on its own; 0 is best
  double trimmed_relmse = 0;  ///< the same without the worst 0.1 % of the pixels, rounded down; 0 is best
  double mae = 0;             ///< mean of |a - b|; 0 is best
  double energy = 0;          ///< sum of a / sum of b; 1 is best
  std::array<LargestDifference, 3> largest;  ///< of R, G, B

  double psnr = 0;  ///< decibels, peak 1; infinite where the displayed images are equal
  double ssim = 0;  ///< mean structural similarity, at most 1, 1 is best; NaN below 11 pixels of width or height
  double flip = 0;  ///< mean of LDR-FLIP at 67 pixels per degree, [0, 1], 0 is best

  /// Mean of HDR-FLIP, [0, 1], 0 is best: of LDR-FLIP's maximum over exposures that the reference chooses.
  double hdr_flip = 0;
};

/// Peak bytes of comparing two images of so many pixels, beside the images.
std::uint64_t comparing_bytes(std::uint64_t pixels);

/// Whether images of which this is known can be compared: windows, channels and view; pixels are not looked at. Throws
/// Error(input) where data windows or views differ or one of R, G, B is missing.
void check_comparable(const Image& image, const Image& reference);

/// Compares the R, G, B channels by name. Throws as check_comparable() does.
ImageError compare_images(const Image& image, const Image& reference);

/// Where the error is: an image with the one channel "relMSE", in each pixel the mean over R, G, B of
/// (a - b)^2 / (b^2 + 0.01), in the reference's windows. Throws as check_comparable() does.
Image relative_error_map(const Image& image, const Image& reference);

}  // namespace rpf
