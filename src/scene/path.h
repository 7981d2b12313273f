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
};

struct Path {
  Vec3 radiance;
  SurfacePoint first, second;
};

}  // namespace rpf::scene
