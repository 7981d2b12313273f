// What one sample brings back.
#pragma once

#include "scene/sampler.h"
#include "scene/vector.h"

namespace rpf::scene {

/// The scene features of one hit.
struct SurfacePoint {
  bool hit = false;
  Vec3 position, normal, albedo;
  Pair uv;
  Vec3 opening = {},
       closing = {};  ///< where this point of the surface was when the shutter opened, and will be when it closes
};

struct Path {
  Vec3 radiance;
  SurfacePoint first, second;
};

/// What stands between a point and the light that its sample chose.
struct Penumbra {
  float slope = 0;  ///< d1 / d2 - 1, where d1 is from the light to the point, d2 to what blocks it nearest to the point
  float width = 0;  ///< that times half the edge of a square as large as the light, scene units
};

}  // namespace rpf::scene
