// Errors of a part of the picture, and how much of what is in it was kept.
#pragma once

#include <string>

#include "rpf/image.h"

namespace rpf::study {

/// A part of a scene's picture. Unit: the frame's width; from the frame's center, since a scene's picture keeps its
/// width and its center whatever the format.
struct Region {
  const char* name;
  double x, y, width, height;
};

/// The pixels of the region, at least one, cut off where the frame ends. Counts from the first pixel.
Window window_of(const Region& region, const Window& frame);

/// Mean over the region's pixels and R, G, B of (a - b)^2 / (b^2 + 0.01).
double region_error(const Image& image, const Image& reference, const Region& region);

/// How much of the reference's detail the image has, where the reference has it: the slope of the image's luminance
/// over the reference's (their covariance over its variance), each less its mean over a square of a sixteenth of the
/// frame's width, so that shading does not count. 1: all; 0: none; noise does not matter. NaN where there is no detail.
double kept_detail(const Image& image, const Image& reference, const Region& region);

/// The slope of the means of the region's columns: what is kept of an upright edge, whatever textures are on it.
double kept_step(const Image& image, const Image& reference, const Region& region);

}  // namespace rpf::study
