// The camera that a frame was rendered with, from the attributes of its file (docs/file-format.md).
#pragma once

#include <array>

#include "rpf/image.h"

namespace rpf {

struct CameraFacts {
  using Row = std::array<double, 4>;  ///< what stands before a position's coordinates, and 1
  std::array<Row, 3> film = {};       ///< x and y, pixels of the data window, times the third
  Row depth = {};                     ///< along the axis, scene units
  /// How far the edge of the lens moves what has a shift of 1 (11.2), pixels.
  std::array<double, 2> right = {}, up = {};
  double inverse_focus = 0;  ///< 1 / scene units
};

/// Of a frame with these windows. Throws Error(input) that names the attribute that is missing or cannot be.
CameraFacts camera_of(const Metadata& metadata, const Window& data_window, const Window& display_window);

}  // namespace rpf
