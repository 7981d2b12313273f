// What a box width means.
#pragma once

namespace rpf {

/// Pixels to each side of the center.
constexpr int box_reach(int box_width) { return (box_width - 1) / 2; }

/// Standard deviation of distances on the film, in pixels: of draws (section 3) and of fixed weights (section 8).
constexpr double box_sigma(int box_width) { return box_width / 4.0; }

}  // namespace rpf
