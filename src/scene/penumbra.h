// What the light that a sample chose meets on its way: from that follows how wide a shadow's edge is.
#pragma once

#include "scene/path.h"
#include "scene/tracer.h"
#include "scene/world.h"

namespace rpf::scene {

/// A point of an area light, and which light.
struct LightPoint {
  int light = 0;
  Vec3 position;
};

/// u chooses the light too. The world has one.
LightPoint light_point(const World& world, Pair random);

/// All 0 where the light arrives, or where the surface faces away from it. `ray`: that hit the surface.
Penumbra penumbra_of(const World& world, const Tracer& tracer, const Ray& ray, const SurfacePoint& surface,
                     Pair random);

}  // namespace rpf::scene
