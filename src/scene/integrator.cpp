#include "scene/integrator.h"

#include <algorithm>

#include "scene/penumbra.h"
#include "scene/random.h"

namespace rpf::scene {
namespace {

/// A hit with all that shading needs; directions are in the frame of the normal that faces the viewer.
struct Shading {
  Hit hit;
  Vec3 color;
  Frame3 frame;
  Vec3 out;  ///< towards the viewer, local
  float time = 0;
};

Shading shading_of(const Hit& hit, const Ray& ray) {
  const bool from_behind = dot(hit.normal, ray.direction) > 0;
  Shading s{hit,
            color_at(hit.material->color, hit.uv.u, hit.uv.v),
            frame_around(from_behind ? -hit.normal : hit.normal),
            {},
            ray.time};
  s.out = s.frame.to_local(-ray.direction);
  return s;
}

SurfacePoint features_of(const Shading& s) {
  const auto at = [&](float time) {
    return s.hit.solid ? s.hit.solid->carried(s.hit.position, s.time, time) : s.hit.position;
  };
  return {true, s.hit.position, s.hit.normal, s.color, s.hit.uv, at(0), at(1)};
}

/// Density of choosing this point of a light, a steradian as seen from `distance` along `direction`.
float light_density(const World& world, int light, const Vec3& direction, float distance) {
  const Rectangle& shape = world.lights[light].shape;
  const float cosine = -dot(shape.normal(), direction);
  if (cosine <= 0) return 0;
  return distance * distance / (cosine * shape.area() * static_cast<float>(world.lights.size()));
}

/// Share of a strategy that had the density `mine` against one that had `other`: the balance heuristic.
float share(float mine, float other) { return mine / (mine + other); }

/// Light that comes straight from a chosen point of an area light. u chooses the light too.
Vec3 light_from_lights(const World& world, const Tracer& tracer, const Shading& s, Pair random, Strategy strategy) {
  if (world.lights.empty() || strategy == Strategy::rays_only) return {};
  const auto [number, point] = light_point(world, random);
  const AreaLight& light = world.lights[number];
  const Vec3 way = point - s.hit.position;
  const float distance = length(way);
  const Vec3 direction = 1 / distance * way, in = s.frame.to_local(direction);
  const Vec3 value = reflected(*s.hit.material, s.color, s.out, in);
  const float chosen = light_density(world, number, direction, distance);
  if (chosen == 0 || is_black(value)) return {};
  if (tracer.blocked({s.hit.position, direction, s.time}, distance * (1 - 1e-4F))) return {};
  const float weight = strategy == Strategy::both ? share(chosen, density(*s.hit.material, s.out, in)) : 1.0F;
  return weight / chosen * value * light.radiance;
}

/// Light that a surface sends out itself. `scattered`: density with which the ray was chosen; 0: no other way to it.
Vec3 emitted(const World& world, const Shading& s, const Ray& ray, float scattered, Strategy strategy) {
  if (dot(s.hit.normal, ray.direction) >= 0) return {};
  if (s.hit.light < 0 || scattered == 0 || strategy == Strategy::rays_only) return s.hit.material->emission;
  if (strategy == Strategy::lights_only) return {};
  return share(scattered, light_density(world, s.hit.light, ray.direction, s.hit.distance)) * s.hit.material->emission;
}

}  // namespace

Path trace_path(const World& world, const Tracer& tracer, Ray ray, const Draw& draw, Strategy strategy) {
  Path path;
  Stream further(draw.further);
  Vec3 throughput = {1, 1, 1};
  float scattered = 0;
  for (int bounce = 0; bounce <= world.scatterings; ++bounce) {
    const std::optional<Hit> hit = tracer.nearest(ray);
    if (!hit) {
      path.radiance = path.radiance + throughput * world.sky;
      break;
    }
    const Shading s = shading_of(*hit, ray);
    if (bounce == 0) path.first = features_of(s);
    if (bounce == 1) path.second = features_of(s);
    path.radiance = path.radiance + throughput * emitted(world, s, ray, scattered, strategy);
    if (bounce == world.scatterings) break;

    const auto next_pair = [&] {
      const float u = further.next();
      return Pair{u, further.next()};
    };
    const Pair light = bounce == 0 ? draw.light : next_pair(), bsdf = bounce == 0 ? draw.bsdf : next_pair();
    path.radiance = path.radiance + throughput * light_from_lights(world, tracer, s, light, strategy);
    const Scattered next = sample(*hit->material, s.color, s.out, bsdf);
    if (is_black(next.weight)) break;
    throughput = throughput * next.weight;
    scattered = next.density;
    ray = {hit->position, s.frame.to_world(next.direction), ray.time};
  }
  return path;
}

}  // namespace rpf::scene
