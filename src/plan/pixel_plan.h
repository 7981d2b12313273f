// The plan of a method that filters pixels and not samples: planes, and the steps that make planes of others.
#pragma once

#include <vector>

#include "frame/pixel_planes.h"
#include "pixel_step.h"
#include "rpf/settings.h"

namespace rpf {

struct PixelPlan {
  int width = 0, height = 0;
  std::vector<PixelPlane> inputs;  ///< the first planes; all others are 0 at first
  std::uint32_t planes = 0;        ///< of all, inputs among them
  std::vector<kernel::rpf_pixel_step> steps;
  std::uint32_t result = 0;  ///< the first of the planes that the picture is, one for each carried channel

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Of a method that filters_pixels(). Throws Error(usage) as validate() does, Error(input) where no pixel has two
/// samples and the method has to tell what is noise: all but axis-aligned.
PixelPlan make_pixel_plan(const FrameFacts& facts, const Settings& settings);

}  // namespace rpf
