#include "scene/penumbra.h"

#include <algorithm>
#include <cmath>

namespace rpf::scene {

LightPoint light_point(const World& world, Pair random) {
  const float scaled = random.u * static_cast<float>(world.lights.size());
  const int number = std::min(static_cast<int>(scaled), static_cast<int>(world.lights.size()) - 1);
  const Rectangle& shape = world.lights[number].shape;
  return {number, shape.corner + (scaled - static_cast<float>(number)) * shape.edge_u + random.v * shape.edge_v};
}

Penumbra penumbra_of(const World& world, const Tracer& tracer, const Ray& ray, const SurfacePoint& surface,
                     Pair random) {
  if (world.lights.empty() || !surface.hit) return {};
  const auto [number, point] = light_point(world, random);
  const Vec3 way = point - surface.position;
  const float distance = length(way);
  const Vec3 direction = 1 / distance * way;
  const bool from_behind = dot(surface.normal, ray.direction) > 0;
  if (dot(from_behind ? -surface.normal : surface.normal, direction) <= 0) return {};
  const std::optional<Hit> blocker = tracer.nearest({surface.position, direction, ray.time});
  if (!blocker || blocker->distance >= distance * (1 - 1e-4F)) return {};
  const float slope = blocker->distance / (distance - blocker->distance);
  return {slope, slope * std::sqrt(world.lights[number].shape.area()) / 2};
}

}  // namespace rpf::scene
