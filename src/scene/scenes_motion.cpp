// Scenes whose noise comes from the shutter time.
#include "scene/registry.h"
#include "scene/staging.h"

namespace rpf::scene {
namespace {

Solid moving(Solid solid, const Vec3& velocity) {
  solid.velocity = velocity;
  return solid;
}

Solid turning(Solid solid, const Vec3& axis, float angle, float turn) {
  solid.axis = normalize(axis);
  solid.angle = angle;
  solid.turn = turn;
  return solid;
}

}  // namespace

World motion() {
  World world;
  world.camera = look({0, 1.5F, 5}, {0, 0.8F, 0}, 1);
  world.sky = {0.1F, 0.12F, 0.16F};
  world.scatterings = 1;
  add_checkered_floor(world);
  add_ceiling_light(world, {-1, 6, 2}, 0.5F, {700, 680, 620});
  const std::uint32_t checks = world.add(textured({Pattern::checker, {0.85F, 0.8F, 0.2F}, {0.15F, 0.1F, 0.3F}, 4}));
  const std::uint32_t globe = world.add(textured({Pattern::checker, {0.8F, 0.2F, 0.15F}, {0.9F, 0.9F, 0.9F}, 8}));
  const std::uint32_t blue = world.add(plain({0.1F, 0.3F, 0.75F}));
  world.add(moving(sphere({-2.2F, 0.5F, 0.3F}, 0.5F, blue), {1, 0, 0}));
  world.add(moving(sphere({0.9F, 1.3F, 0.4F}, 0.3F, globe), {0.2F, 0.5F, 0.1F}));
  world.add(turning(box({0, 0.62F, -0.5F}, {0.55F, 0.6F, 0.55F}, checks), {0, 1, 0}, 0.3F, 0.9F));
  world.add(turning(box({1.9F, 0.9F, -0.8F}, {0.8F, 0.12F, 0.12F}, globe), {0, 0, 1}, 0.2F, 1.2F));
  world.add(turning(sphere({-1.3F, 0.55F, -2}, 0.55F, globe), {0, 1, 0}, 0, 0.8F));
  world.add(moving(turning(box({3.2F, 0.4F, -3}, {0.4F, 0.4F, 0.4F}, checks), {1, 1, 0}, 0, 1), {-1, 0.3F, 0}));
  return world;
}

World combined() {
  World world;
  world.camera = look({0, 1.4F, 5}, {0, 0.75F, 0}, 1);
  open_lens(world.camera, 0.1F, 5);
  world.sky = {0.05F, 0.06F, 0.08F};
  world.scatterings = 1;
  add_checkered_floor(world);
  add_ceiling_light(world, {1.5F, 5, 3.5F}, 3, {18, 17, 16});
  const std::uint32_t checks = world.add(textured({Pattern::checker, {0.85F, 0.8F, 0.2F}, {0.15F, 0.1F, 0.3F}, 4}));
  const std::uint32_t red = world.add(plain({0.8F, 0.15F, 0.1F})), blue = world.add(plain({0.1F, 0.3F, 0.75F}));
  world.add(moving(sphere({-0.9F, 0.9F, 2.6F}, 0.22F, red), {0.25F, 0.1F, 0}));  // near: blurred by lens and motion
  world.add(moving(sphere({-1.5F, 0.5F, 0}, 0.5F, blue), {0.8F, 0, 0}));         // in focus, moving
  world.add(turning(box({0.9F, 0.6F, -0.2F}, {0.5F, 0.6F, 0.5F}, checks), {0, 1, 0}, 0.3F, 0.7F));
  world.add(sphere({2.8F, 0.8F, -4}, 0.8F, red));  // behind, at rest
  add_card(world, {-2.5F, 0, -5}, 2, 2, checks);
  return world;
}

}  // namespace rpf::scene
