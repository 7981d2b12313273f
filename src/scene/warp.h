// From the unit square to discs and hemispheres.
#pragma once

#include <algorithm>

#include "scene/sampler.h"
#include "scene/vector.h"

namespace rpf::scene {

constexpr float pi = 3.14159265F;

/// A uniform point in the unit disc; neighbors in the square stay neighbors (Shirley and Chiu 1997).
inline Pair to_disc(Pair random) {
  const float a = 2 * random.u - 1, b = 2 * random.v - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::fabs(a) > std::fabs(b);
  const float r = wide ? a : b, angle = wide ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// A direction around +z with density cosine / pi.
inline Vec3 to_cosine_hemisphere(Pair random) {
  const Pair disc = to_disc(random);
  return {disc.u, disc.v, std::sqrt(std::max(1 - disc.u * disc.u - disc.v * disc.v, 1e-12F))};
}

}  // namespace rpf::scene
