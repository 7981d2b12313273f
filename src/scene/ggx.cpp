#include "scene/ggx.h"

#include <algorithm>

#include "scene/warp.h"

namespace rpf::scene {
namespace {

/// Lambda of Smith's shadowing function.
float smith_lambda(const Vec3& direction, float alpha) {
  const float cos2 = direction.z * direction.z;
  if (cos2 <= 0) return 1e20F;
  const float tan2 = std::max(1 - cos2, 0.0F) / cos2;
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

}  // namespace

float ggx_normals(const Vec3& half, float alpha) {
  if (half.z <= 0) return 0;
  const float a2 = alpha * alpha, d = half.x * half.x + half.y * half.y + a2 * half.z * half.z;
  return a2 / (pi * d * d);
}

float ggx_visible(const Vec3& direction, float alpha) { return 1 / (1 + smith_lambda(direction, alpha)); }

float ggx_visible(const Vec3& out, const Vec3& in, float alpha) {
  return 1 / (1 + smith_lambda(out, alpha) + smith_lambda(in, alpha));
}

Vec3 ggx_sample_normal(const Vec3& out, float alpha, Pair random) {
  // Stretched until the microfacets are a hemisphere; its visible half is a disc, bent at the middle.
  const Vec3 stretched = normalize({alpha * out.x, alpha * out.y, out.z});
  const Frame3 frame = frame_around(stretched);
  // The bend lies along the axis that is horizontal in the world of the surface.
  const float horizontal = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 t1 = horizontal > 0 ? 1 / std::sqrt(horizontal) * Vec3{-stretched.y, stretched.x, 0} : frame.x;
  const Vec3 t2 = cross(stretched, t1);
  const Pair disc = to_disc(random);
  const float s = 0.5F * (1 + stretched.z), edge = std::sqrt(std::max(1 - disc.u * disc.u, 0.0F));
  const float v = (1 - s) * edge + s * disc.v;
  const float up = std::sqrt(std::max(1 - disc.u * disc.u - v * v, 0.0F));
  const Vec3 normal = disc.u * t1 + v * t2 + up * stretched;
  return normalize({alpha * normal.x, alpha * normal.y, std::max(normal.z, 1e-7F)});
}

}  // namespace rpf::scene
