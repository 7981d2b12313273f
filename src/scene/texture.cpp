#include "scene/texture.h"

#include "scene/random.h"

namespace rpf::scene {
namespace {

std::uint32_t cell_of(float x) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x))); }

bool is_joint(float u, float v) {
  constexpr float joint = 0.08F;
  const float row = std::floor(v), along = u / 2 + 0.5F * (row - 2 * std::floor(row / 2));
  return v - row < joint || along - std::floor(along) < joint / 2;
}

}  // namespace

Vec3 color_at(const Texture& texture, float u, float v) {
  u *= texture.cells;
  v *= texture.cells;
  switch (texture.pattern) {
    case Pattern::plain:
      return texture.first;
    case Pattern::checker:
      return ((cell_of(u) + cell_of(v)) & 1U) == 0 ? texture.first : texture.second;
    case Pattern::grain: {
      const float mixture = to_unit(hash(hash(cell_of(u)), cell_of(v)));
      return texture.first + mixture * (texture.second - texture.first);
    }
    case Pattern::bricks:
      return is_joint(u, v) ? texture.second : texture.first;
  }
  return texture.first;
}

}  // namespace rpf::scene
