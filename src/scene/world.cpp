#include "scene/world.h"

#include <algorithm>

namespace rpf::scene {

Usage World::usage() const {
  if (direct) return {true, true, true, true};
  const bool moves = std::any_of(solids.begin(), solids.end(), [](const Solid& solid) { return solid.moves(); });
  return {camera.lens_radius > 0, moves, scatterings > 0 && !lights.empty(), scatterings > 0};
}

std::uint32_t World::add(const Material& material) {
  materials.push_back(material);
  return static_cast<std::uint32_t>(materials.size() - 1);
}

void World::add(const Rectangle& rectangle, std::uint32_t material) {
  Mesh mesh;
  mesh.material = material;
  add_rectangle(mesh, rectangle);
  meshes.push_back(mesh);
}

void World::add(const AreaLight& light) {
  add(light.shape, add(glowing(light.radiance, {0, 0, 0})));
  meshes.back().light = static_cast<int>(lights.size());
  lights.push_back(light);
}

Material plain(const Vec3& color) { return textured({Pattern::plain, color, {}, 1}); }

Material textured(const Texture& texture) {
  Material material;
  material.color = texture;
  return material;
}

Material metal(const Vec3& color, float roughness) {
  Material material = plain(color);
  material.reflection = Reflection::glossy;
  material.roughness = roughness;
  return material;
}

Material mirror(const Vec3& color) {
  Material material = plain(color);
  material.reflection = Reflection::mirror;
  return material;
}

Material glowing(const Vec3& radiance, const Vec3& color) {
  Material material = plain(color);
  material.reflection = Reflection::none;
  material.emission = radiance;
  return material;
}

}  // namespace rpf::scene
