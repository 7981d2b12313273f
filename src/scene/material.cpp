#include "scene/material.h"

#include <algorithm>

#include "scene/ggx.h"
#include "scene/warp.h"

namespace rpf::scene {
namespace {

constexpr float least_cosine = 1e-6F;

/// Schlick's approximation; `cosine` between direction and microfacet normal.
Vec3 fresnel(const Vec3& color, float cosine) {
  const float m = std::clamp(1 - cosine, 0.0F, 1.0F), m5 = m * m * m * m * m;
  return color + m5 * (Vec3{1, 1, 1} - color);
}

bool both_above(const Vec3& out, const Vec3& in) { return out.z > least_cosine && in.z > least_cosine; }

}  // namespace

Vec3 reflected(const Material& material, const Vec3& color, const Vec3& out, const Vec3& in) {
  if (!both_above(out, in)) return {};
  if (material.reflection == Reflection::diffuse) return in.z / pi * color;
  if (material.reflection != Reflection::glossy) return {};
  const Vec3 half = normalize(out + in);
  const float alpha = material.roughness;
  return ggx_normals(half, alpha) * ggx_visible(out, in, alpha) / (4 * out.z) * fresnel(color, dot(in, half));
}

float density(const Material& material, const Vec3& out, const Vec3& in) {
  if (!both_above(out, in)) return 0;
  if (material.reflection == Reflection::diffuse) return in.z / pi;
  if (material.reflection != Reflection::glossy) return 0;
  const Vec3 half = normalize(out + in);
  return ggx_visible(out, material.roughness) * ggx_normals(half, material.roughness) / (4 * out.z);
}

Scattered sample(const Material& material, const Vec3& color, const Vec3& out, Pair random) {
  switch (material.reflection) {
    case Reflection::diffuse: {
      const Vec3 in = to_cosine_hemisphere(random);
      return {in, color, in.z / pi};
    }
    case Reflection::glossy: {
      if (out.z <= least_cosine) return {};
      const Vec3 half = ggx_sample_normal(out, material.roughness, random);
      const Vec3 in = 2 * dot(out, half) * half - out;
      if (in.z <= least_cosine) return {};
      const float seen = ggx_visible(out, in, material.roughness) / ggx_visible(out, material.roughness);
      return {in, seen * fresnel(color, dot(in, half)), density(material, out, in)};
    }
    case Reflection::mirror:
      return {{-out.x, -out.y, out.z}, fresnel(color, out.z), 0};
    case Reflection::none:
      break;
  }
  return {};
}

}  // namespace rpf::scene
