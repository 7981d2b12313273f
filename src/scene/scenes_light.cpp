// Scenes whose noise comes from lights and reflections.
#include "scene/registry.h"
#include "scene/staging.h"
#include "scene/warp.h"

namespace rpf::scene {
namespace {

/// The body of a pot: height 0 to 1, from the bottom to the knob of its lid. Outwards is its normal.
Vec3 pot_body(float u, float v) {
  const float angle = -2 * pi * u, radius = 0.001F +
                                            0.62F * std::pow(std::fabs(std::sin(pi * v)), 0.7F) * (1 - 0.35F * v) +
                                            0.05F * std::sin(3 * pi * v) * std::sin(pi * v);
  return {radius * std::cos(angle), v, radius * std::sin(angle)};
}

/// A ring that stands at the side of the body: the handle.
Vec3 pot_handle(float u, float v) {
  const float around = 2 * pi * u, across = 2 * pi * v, radius = 0.28F + 0.055F * std::cos(across);
  return {0.6F + radius * std::cos(around), 0.5F + radius * std::sin(around), 0.055F * std::sin(across)};
}

/// A tube that grows narrower and rises: the spout.
Vec3 pot_spout(float u, float v) {
  const float angle = 2 * pi * u, radius = 0.13F - 0.08F * v;
  return {-0.4F - 0.55F * v - radius * std::sin(angle) * 0.7F, 0.3F + 0.5F * v * v + radius * std::sin(angle),
          radius * std::cos(angle)};
}

/// True where a cell of 9 x 9 x 9 belongs to the sponge of level 2.
bool in_sponge(int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x > 8 || y > 8 || z > 8) return false;
  for (const int size : {1, 3}) {
    const auto is_middle = [&](int c) { return c / size % 3 == 1 ? 1 : 0; };
    if (is_middle(x) + is_middle(y) + is_middle(z) >= 2) return false;
  }
  return true;
}

/// The face of a cell towards +axis or -axis.
Rectangle cell_face(const std::array<int, 3>& cell, int axis, bool positive) {
  std::array<float, 3> corner{}, u{}, v{};
  for (int k = 0; k < 3; ++k) corner[k] = static_cast<float>(cell[k]);
  if (positive) corner[axis] += 1;
  u[(axis + (positive ? 1 : 2)) % 3] = 1;
  v[(axis + (positive ? 2 : 1)) % 3] = 1;
  return {{corner[0], corner[1], corner[2]}, {u[0], u[1], u[2]}, {v[0], v[1], v[2]}};
}

void add_cell(Mesh& mesh, const std::array<int, 3>& cell) {
  if (!in_sponge(cell[0], cell[1], cell[2])) return;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool positive : {false, true}) {
      std::array<int, 3> beside = cell;
      beside[axis] += positive ? 1 : -1;
      if (!in_sponge(beside[0], beside[1], beside[2])) add_rectangle(mesh, cell_face(cell, axis, positive));
    }
}

Mesh sponge() {
  Mesh mesh;
  for (int z = 0; z < 9; ++z)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 9; ++x) add_cell(mesh, {x, y, z});
  return mesh;
}

/// Scales, turns around the y axis and moves.
void place(Mesh& mesh, float scale, float angle, const Vec3& position) {
  for (Vertex& vertex : mesh.vertices) {
    vertex.position = position + rotate(scale * vertex.position, {0, 1, 0}, angle);
    vertex.normal = rotate(vertex.normal, {0, 1, 0}, angle);
  }
}

}  // namespace

World soft_shadow() {
  World world;
  world.camera = look({0, 1.8F, 5}, {0, 0.7F, 0}, 1);
  world.scatterings = 1;
  add_checkered_floor(world);
  const std::uint32_t white = world.add(plain({0.7F, 0.7F, 0.68F})), red = world.add(plain({0.75F, 0.2F, 0.15F}));
  world.add(Rectangle{{-12, 0, -3}, {24, 0, 0}, {0, 8, 0}}, white);  // wall
  add_ceiling_light(world, {-2, 4.5F, 1.5F}, 2.5F, {18, 17, 15});
  world.add(sphere({-0.9F, 0.6F, 0}, 0.6F, red));
  world.add(box({1.1F, 0.8F, -0.6F}, {0.35F, 0.8F, 0.35F}, white));
  for (int post = 0; post < 5; ++post)
    world.add(box({0.3F + 0.35F * static_cast<float>(post), 0.45F, 1.1F}, {0.04F, 0.45F, 0.04F}, white));
  return world;
}

World glossy() {
  World world = cornell_box();
  const std::uint32_t copper = world.add(metal({0.93F, 0.62F, 0.45F}, 0.18F));
  Mesh pot;
  pot.material = copper;
  add_surface(pot, 96, 64, pot_body);
  add_surface(pot, 48, 16, pot_handle);
  add_surface(pot, 32, 16, pot_spout);
  place(pot, 1.25F, 0.5F, {0, 0, 0});
  world.meshes.push_back(pot);
  world.add(sphere({-1.25F, 0.3F, 0.3F}, 0.3F, world.add(mirror({0.9F, 0.9F, 0.9F}))));
  world.add(box({1.2F, 0.3F, -0.1F}, {0.25F, 0.3F, 0.25F}, world.add(plain({0.3F, 0.4F, 0.7F}))));
  return world;
}

World menger() {
  World world = cornell_box();
  Mesh body = sponge();
  body.material = world.add(plain({0.7F, 0.65F, 0.5F}));
  constexpr float size = 1.1F;
  for (Vertex& vertex : body.vertices) vertex.position = vertex.position - Vec3{4.5F, 0, 4.5F};
  place(body, size / 9, 0.55F, {0, 0.02F, -0.2F});
  world.meshes.push_back(body);
  return world;
}

}  // namespace rpf::scene
