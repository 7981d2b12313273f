// Procedural textures: a color for every (u, v).
#pragma once

#include "scene/vector.h"

namespace rpf::scene {

enum class Pattern {
  plain,    ///< `first` everywhere
  checker,  ///< `first` and `second` in turns
  grain,    ///< every cell a random mixture of `first` and `second`: looks like noise
  bricks    ///< `first` with joints of `second`, one cell high and two wide
};

struct Texture {
  Pattern pattern = Pattern::plain;
  Vec3 first, second;
  float cells = 1;  ///< a unit of u or v
};

Vec3 color_at(const Texture& texture, float u, float v);

}  // namespace rpf::scene
