// Scenes whose statistics are known.
#include "scene/random.h"
#include "scene/registry.h"
#include "scene/staging.h"

namespace rpf::scene {
namespace {

Vec3 next_vector(Stream& random) {
  const float x = random.next(), y = random.next();
  return {x, y, random.next()};
}

SurfacePoint noise_point(Stream& random) {
  SurfacePoint point;
  point.hit = true;
  point.position = point.opening = point.closing = next_vector(random);
  point.normal = next_vector(random);
  point.albedo = next_vector(random);
  const float u = random.next();
  point.uv = {u, random.next()};
  return point;
}

Path noise_path(const Draw& draw, float, float) {
  Stream random(draw.further);
  Path path;
  path.radiance = next_vector(random);
  path.first = noise_point(random);
  path.second = noise_point(random);
  return path;
}

float coin(float random) { return random < 0.5F ? 0.25F : 0.75F; }

Path two_values_path(const Draw& draw, float film_x, float film_y) {
  Stream random(draw.further);
  const float albedo = coin(random.next());
  Path path;
  path.radiance = {coin(draw.lens.u), coin(draw.time), albedo};
  const Vec3 place = {film_x / 64, film_y / 64, 0};
  path.first = {true, place, {0, 0, 1}, {albedo, albedo, albedo}, {0, 0}, place, place};
  return path;
}

}  // namespace

World constant() {
  World world;
  world.camera = look({0, 0, 0}, {0, 0, -1}, 1);
  world.scatterings = 0;
  const Vec3 radiance = {0.25F, 0.5F, 0.75F};
  world.add(Rectangle{{-100, -100, -2}, {200, 0, 0}, {0, 200, 0}}, world.add(glowing(radiance, radiance)));
  return world;
}

World noise() {
  World world;
  world.direct = noise_path;
  return world;
}

World two_values() {
  World world;
  world.direct = two_values_path;
  return world;
}

}  // namespace rpf::scene
