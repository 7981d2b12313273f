// What surfaces do with light. Directions are unit vectors in the surface's frame (z is the normal) and point away from
// the surface; the viewer is on the side of +z.
#pragma once

#include "scene/sampler.h"
#include "scene/texture.h"

namespace rpf::scene {

enum class Reflection {
  diffuse,
  glossy,  ///< a metal of GGX microfacets; the color is the reflectance along the normal (Schlick)
  mirror,
  none  ///< absorbs; lights
};

struct Material {
  Reflection reflection = Reflection::diffuse;
  Texture color;
  float roughness = 0.2F;  ///< alpha of GGX, above 0
  Vec3 emission;           ///< radiance, to the side that the normal points to
};

/// A direction chosen by sample().
struct Scattered {
  Vec3 direction;
  Vec3 weight;        ///< value * cosine / density; black: the path ends
  float density = 0;  ///< a steradian; 0 for a mirror: no other strategy could have chosen it
};

/// BSDF times cosine of the incoming direction; black where `in` is below the surface. 0 for a mirror.
Vec3 reflected(const Material& material, const Vec3& color, const Vec3& out, const Vec3& in);

/// The density with which sample() chooses `in`, a steradian. 0 for a mirror.
float density(const Material& material, const Vec3& out, const Vec3& in);

Scattered sample(const Material& material, const Vec3& color, const Vec3& out, Pair random);

}  // namespace rpf::scene
