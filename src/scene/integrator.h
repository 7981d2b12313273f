// One sample: the light that arrives along a camera ray, and the features of its first two hits.
#pragma once

#include "scene/path.h"
#include "scene/tracer.h"
#include "scene/world.h"

namespace rpf::scene {

/// How light from area lights is found. All three have the same expectation; the renderer uses `both`.
enum class Strategy {
  both,         ///< points on lights and scattered rays, weighted by the balance heuristic
  lights_only,  ///< points on lights (and scattered rays after a mirror, where nothing else can work)
  rays_only     ///< scattered rays that happen to hit a light
};

Path trace_path(const World& world, const Tracer& tracer, Ray ray, const Draw& draw,
                Strategy strategy = Strategy::both);

}  // namespace rpf::scene
