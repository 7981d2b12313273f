#include "scene/staging.h"

namespace rpf::scene {
namespace {

Vertex surface_vertex(const std::function<Vec3(float, float)>& point, float u, float v) {
  constexpr float step = 1e-3F;
  const Vec3 along_u = point(u + step, v) - point(u - step, v), along_v = point(u, v + step) - point(u, v - step);
  return {point(u, v), normalize(cross(along_u, along_v)), {u, v}};
}

}  // namespace

Camera look(const Vec3& position, const Vec3& target, float width_at_one) {
  Camera camera;
  camera.position = position;
  camera.target = target;
  camera.width_at_one = width_at_one;
  return camera;
}

void open_lens(Camera& camera, float radius, float focus) {
  camera.lens_radius = radius;
  camera.focus = focus;
}

void add_floor(World& world, const Texture& texture) {
  world.add(Rectangle{{-12, 0, 12}, {24, 0, 0}, {0, 0, -24}}, world.add(textured(texture)));
}

void add_checkered_floor(World& world) {
  add_floor(world, {Pattern::checker, {0.75F, 0.75F, 0.7F}, {0.15F, 0.2F, 0.25F}, 24});
}

void add_ceiling_light(World& world, const Vec3& center, float size, const Vec3& radiance) {
  const Vec3 corner = center - Vec3{size / 2, 0, size / 2};
  world.add(AreaLight{{corner, {size, 0, 0}, {0, 0, size}}, radiance});
}

void add_card(World& world, const Vec3& foot, float width, float height, std::uint32_t material) {
  world.add(Rectangle{foot - Vec3{width / 2, 0, 0}, {width, 0, 0}, {0, height, 0}}, material);
}

Solid sphere(const Vec3& center, float radius, std::uint32_t material) {
  Solid solid;
  solid.center = center;
  solid.half_size = {radius, radius, radius};
  solid.material = material;
  return solid;
}

Solid box(const Vec3& center, const Vec3& half_size, std::uint32_t material) {
  Solid solid;
  solid.kind = Solid::Kind::box;
  solid.center = center;
  solid.half_size = half_size;
  solid.material = material;
  return solid;
}

World cornell_box() {
  constexpr float side = 1.78F;
  World world;
  world.camera = look({0, 1, 4.45F}, {0, 1, 0}, 1.02F);
  world.scatterings = 2;
  const std::uint32_t white = world.add(plain({0.73F, 0.73F, 0.73F}));
  const std::uint32_t red = world.add(plain({0.63F, 0.06F, 0.05F}));
  const std::uint32_t green = world.add(plain({0.14F, 0.45F, 0.09F}));
  world.add(Rectangle{{-side, 0, 1}, {2 * side, 0, 0}, {0, 0, -2}}, white);  // floor
  world.add(Rectangle{{-side, 2, -1}, {2 * side, 0, 0}, {0, 0, 2}}, white);  // ceiling
  world.add(Rectangle{{-side, 0, -1}, {2 * side, 0, 0}, {0, 2, 0}}, white);  // back
  world.add(Rectangle{{-side, 0, 1}, {0, 0, -2}, {0, 2, 0}}, red);           // left
  world.add(Rectangle{{side, 0, -1}, {0, 0, 2}, {0, 2, 0}}, green);          // right
  add_ceiling_light(world, {0, 1.99F, 0.5F}, 0.7F, {17, 14, 10});
  return world;
}

void add_surface(Mesh& mesh, int columns, int rows, const std::function<Vec3(float, float)>& point) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      mesh.vertices.push_back(surface_vertex(point, static_cast<float>(column) / static_cast<float>(columns),
                                             static_cast<float>(row) / static_cast<float>(rows)));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t corner =
          first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
      mesh.triangles.push_back({corner, corner + 1, corner + stride + 1});
      mesh.triangles.push_back({corner, corner + stride + 1, corner + stride});
    }
}

}  // namespace rpf::scene
