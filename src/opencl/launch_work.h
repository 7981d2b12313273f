// How much work a launch is: no launch can be stopped, so none may take long.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "frame/frame.h"
#include "plan/plan.h"
#include "rpf_math.h"

namespace rpf {

/// Own samples and, at most, neighbors of a pixel; or the most of each in a tile.
struct PixelWork {
  std::uint64_t own = 0, neighbors = 0;

  /// At most: a neighbor is weighed for the own samples of one group.
  std::uint64_t weights() const { return kernel::rpf_group_size(static_cast<std::uint32_t>(own)) * neighbors; }
};

/// Of a pixel without samples all is 0.
PixelWork pixel_work(const Frame& frame, const Plan& plan, int pass, int x, int y);
PixelWork most_work(const Frame& frame, const Plan& plan, int pass, const Window& tile);

/// Of all pixels of a tile, with what finding and measuring the neighborhoods costs in the same unit.
std::uint64_t work_of(const Frame& frame, const Plan& plan, int pass, const Window& tile);

/// Whether any pixel can have more weights than so many.
bool has_long_pixels(const Plan& plan, std::uint64_t weights_at_once);

/// A tile of more than one pixel in two.
std::array<Window, 2> halves_of(const Window& tile);

}  // namespace rpf
