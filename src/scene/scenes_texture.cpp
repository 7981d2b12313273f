// Scenes about textures and normals.
#include "scene/registry.h"
#include "scene/staging.h"

namespace rpf::scene {

World column() {
  World world;
  world.camera = look({0, 1.3F, 4}, {0, 1.1F, 0}, 1);
  world.scatterings = 1;
  add_floor(world, {Pattern::checker, {0.6F, 0.55F, 0.5F}, {0.5F, 0.45F, 0.4F}, 48});
  add_ceiling_light(world, {0.4F, 5, 4}, 2, {28, 26, 23});
  const std::uint32_t bricks = world.add(textured({Pattern::bricks, {0.6F, 0.35F, 0.25F}, {0.8F, 0.78F, 0.7F}, 9}));
  world.add(Rectangle{{-12, 0, -3}, {24, 0, 0}, {0, 6, 0}}, world.add(plain({0.5F, 0.52F, 0.55F})));
  // The corner points to the camera; the right side's normal points inwards: it is seen from behind.
  const Vec3 corner = {0, 0, 0.8F}, height = {0, 2.6F, 0};
  world.add(Rectangle{corner - Vec3{0.8F, 0, 0.8F}, {0.8F, 0, 0.8F}, height}, bricks);
  world.add(Rectangle{corner + Vec3{0.8F, 0, -0.8F}, {-0.8F, 0, 0.8F}, height}, bricks);
  return world;
}

World random_texture() {
  World world;
  world.camera = look({0, 1.4F, 4}, {0, 0.6F, 0}, 1);
  open_lens(world.camera, 0.03F, 4);
  world.scatterings = 1;
  add_floor(world, {Pattern::grain, {0.1F, 0.1F, 0.1F}, {0.9F, 0.85F, 0.8F}, 1200});
  add_ceiling_light(world, {-1, 5, 2}, 2.5F, {20, 19, 17});
  const std::uint32_t grain = world.add(textured({Pattern::grain, {0.7F, 0.1F, 0.1F}, {0.2F, 0.3F, 0.9F}, 90}));
  world.add(sphere({-0.8F, 0.6F, 0}, 0.6F, grain));
  world.add(box({0.9F, 0.5F, -0.3F}, {0.5F, 0.5F, 0.5F}, grain));
  return world;
}

}  // namespace rpf::scene
