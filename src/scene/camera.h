// A thin lens.
#pragma once

#include "scene/shapes.h"

namespace rpf::scene {

struct Camera {
  Vec3 position = {0, 0, 0}, target = {0, 0, -1};
  float width_at_one = 1;  ///< width of what the image shows at distance 1: 2 tan(half of the horizontal field of view)
  float focus = 1;         ///< distance along the axis at which points are sharp, scene units
  float lens_radius = 0;   ///< scene units; 0: pinhole

  /// Its axes in the world.
  struct Axes {
    Vec3 right, up, forward;
  };
  Axes axes() const;
  /// The ray through a film position (pixels) of a frame of that size.
  Ray ray(float film_x, float film_y, int width, int height, Pair lens, float time) const;
};

}  // namespace rpf::scene
