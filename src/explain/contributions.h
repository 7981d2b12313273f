// Which samples a pixel of a preset's picture is made of: the passes of docs/network.md, read backwards.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "learned/estimate_plan.h"

namespace rpf {

/// A pixel's result is `factor` times the mean of the samples' colors, weighted by `shares`.
struct PixelShares {
  Window window;                      ///< frame coordinates: the pixels that the passes reach
  std::vector<double> pixels;         ///< [pixel of the window, row by row] they sum to 1
  std::vector<double> within_pixels;  ///< [sample of the window] of its pixel's samples: a pixel's sum to 1
  /// The pixel's own albedo against that of its samples, blended; 1 without albedo.
  std::array<double, 3> factor = {1, 1, 1};
};

/// `window`: window_around(region_of_shares()), whose stages these are; x, y: the pixel, frame coordinates.
/// `samples`: [pixel of the window] how many it has.
PixelShares pixel_shares(const EstimatePlan& plan, const std::vector<EstimateStage>& stages, const Window& window,
                         const std::vector<std::uint32_t>& samples, int x, int y);

/// The pixels within the passes' reach of one.
Window region_of_shares(const EstimatePlan& plan, int x, int y);

}  // namespace rpf
