// Scenes whose noise comes from the lens.
#include "scene/random.h"
#include "scene/registry.h"
#include "scene/staging.h"

namespace rpf::scene {

World dof() {
  World world;
  world.camera = look({0, 1.4F, 5}, {0, 0.75F, 0}, 1);
  open_lens(world.camera, 0.14F, 5);
  world.sky = {0.05F, 0.06F, 0.08F};
  add_checkered_floor(world);
  add_ceiling_light(world, {1.5F, 6, 4.5F}, 3, {24, 23, 21});
  const std::uint32_t red = world.add(plain({0.8F, 0.15F, 0.1F})), blue = world.add(plain({0.1F, 0.25F, 0.7F}));
  const std::uint32_t gold = world.add(metal({0.9F, 0.7F, 0.3F}, 0.25F)), green = world.add(plain({0.15F, 0.6F, 0.2F}));
  const std::uint32_t stripes = world.add(textured({Pattern::checker, {0.9F, 0.85F, 0.2F}, {0.1F, 0.1F, 0.3F}, 8}));
  world.add(sphere({-0.62F, 0.95F, 2.9F}, 0.22F, red));  // in front of the focus
  world.add(sphere({0.1F, 0.6F, 0}, 0.6F, gold));        // in focus
  world.add(sphere({1.5F, 0.45F, -0.6F}, 0.45F, blue));
  world.add(sphere({-1.9F, 0.7F, -2.5F}, 0.7F, green));  // behind
  world.add(sphere({2.9F, 0.9F, -6}, 0.9F, red));
  add_card(world, {0.75F, 0.55F, 2.9F}, 0.3F, 0.4F, stripes);
  add_card(world, {-1.3F, 0, 0.3F}, 0.7F, 1, stripes);
  add_card(world, {0.6F, 0, -5}, 1.5F, 2, stripes);
  add_card(world, {-4.5F, 0, -7}, 2, 2.2F, blue);
  return world;
}

// The near half-plane is at distance 2 and covers x < 0, the far one at distance 8; sharp is distance 4; lens radius
// 0.4.
World dof_edge() {
  World world;
  world.camera = look({0, 0, 0}, {0, 0, -1}, 1);
  open_lens(world.camera, 0.4F, 4);
  world.scatterings = 0;
  const Vec3 near_color = {0.75F, 0.375F, 0.125F}, far_color = {0.125F, 0.25F, 0.625F};
  world.add(Rectangle{{-100, -100, -2}, {100, 0, 0}, {0, 200, 0}}, world.add(glowing(near_color, near_color)));
  world.add(Rectangle{{-200, -200, -8}, {400, 0, 0}, {0, 400, 0}}, world.add(glowing(far_color, far_color)));
  return world;
}

World dof_thin() {
  World world;
  world.camera = look({0, 1, 4}, {0, 0.7F, 0}, 1);
  open_lens(world.camera, 0.1F, 4);
  world.sky = {0.25F, 0.3F, 0.4F};
  world.scatterings = 1;
  add_floor(world, {Pattern::plain, {0.3F, 0.25F, 0.15F}, {}, 1});
  add_ceiling_light(world, {2, 6, 3}, 3, {25, 24, 20});
  std::uint32_t greens[4];
  for (int i = 0; i < 4; ++i) greens[i] = world.add(plain({0.1F + 0.12F * static_cast<float>(i), 0.6F, 0.1F}));
  Stream random(7);
  for (int blade = 0; blade < 600; ++blade) {
    const float z = 2.6F - 9 * random.next(), reach = (4 - z) * 0.6F;
    const Vec3 foot = {reach * (2 * random.next() - 1), 0, z};
    const Vec3 lean = {0.5F * (random.next() - 0.5F), 0.6F + 0.7F * random.next(), 0.3F * (random.next() - 0.5F)};
    world.add(Rectangle{foot, {0.025F, 0, 0.01F * random.next()}, lean}, greens[blade % 4]);
  }
  return world;
}

World dof_hdr() {
  World world;
  world.camera = look({0, 1.2F, 5}, {0, 0.9F, 0}, 1);
  open_lens(world.camera, 0.16F, 4.5F);
  world.scatterings = 1;
  add_checkered_floor(world);
  add_ceiling_light(world, {0, 7, 2}, 2, {6, 6.4F, 8});
  const std::uint32_t gray = world.add(plain({0.5F, 0.5F, 0.5F}));
  world.add(sphere({-0.5F, 0.5F, 0.5F}, 0.5F, gray));
  world.add(sphere({0.9F, 0.4F, 0}, 0.4F, world.add(metal({0.8F, 0.8F, 0.85F}, 0.15F))));
  Stream random(11);
  for (int light = 0; light < 30; ++light) {
    const float z = light < 4 ? 2.2F : -2 - 8 * random.next(), reach = (5 - z) * 0.45F, size = 0.008F * (5 - z);
    const Vec3 corner = {reach * (2 * random.next() - 1), 0.4F + 0.25F * (5 - z) * random.next(), z};
    const Vec3 tint = {1, 0.3F + 0.7F * random.next(), 0.2F + 0.8F * random.next()};
    world.add(AreaLight{{corner, {size, 0, 0}, {0, size, 0}}, (25 + 40 * random.next()) * tint});
  }
  return world;
}

}  // namespace rpf::scene
