// Steps of the axis-aligned filter of soft shadows (algorithm.md, section 9.4). A pixel's surface is `count` + 1
// planes: 1 where its position is known, and the position, in diagonals of the scene; normals follow.
#ifndef RPF_SHADOW_STEPS_H
#define RPF_SHADOW_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "plane_steps.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// The squared distance of two pixels' values in `count` planes from `first` on.
RPF_INLINE float rpf_squared_distance(const RPF_PLANES float* planes, uint first, uint count, size_t stride, size_t p,
                                      size_t q) {
  float sum = 0.0f;
  for (uint k = 0; k < count; ++k) {
    const float off = planes[(first + k) * stride + q] - planes[(first + k) * stride + p];
    sum = rpf_added(sum, off * off);
  }
  return sum;
}

// The mean squared distance of pixel x, y from those beside it whose positions are known; 0 without any.
RPF_INLINE float rpf_spacing(const RPF_PLANES float* planes, const rpf_pixel_step* step, int x, int y) {
  const size_t stride = (size_t)step->width * (size_t)step->height;
  float sum = 0.0f, known = 0.0f;
  for (int side = 0; side < 4; ++side) {
    const int u = x + (side == 0) - (side == 1), v = y + (side == 2) - (side == 3);
    if (u < 0 || v < 0 || u >= step->width || v >= step->height) continue;
    const size_t p = (size_t)y * (size_t)step->width + (size_t)x, q = (size_t)v * (size_t)step->width + (size_t)u;
    const float there = planes[step->mask * stride + q];
    sum = rpf_added(sum, there * rpf_squared_distance(planes, step->mask + 1, step->count, stride, p, q));
    known = rpf_added(known, there);
  }
  return known > 0.0f ? sum / known : 0.0f;
}

// out: (9.22), 1 / (2 beta^2), 0 where nothing is to be filtered. in: slope, width, 1 where they are the pixel's own;
// by: slope and width of the pixels around it, 0 without any; mask: the surface; scale: (k mu)^2 / 2.
RPF_INLINE void rpf_shadow_falloff(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const RPF_PLANES float* slope = rpf_plane_row(planes, step, step->in, run.y);
  const RPF_PLANES float* width = rpf_plane_row(planes, step, step->in + 1, run.y);
  const RPF_PLANES float* blocked = rpf_plane_row(planes, step, step->in + 2, run.y);
  const RPF_PLANES float* slope_around = rpf_plane_row(planes, step, step->by, run.y);
  const RPF_PLANES float* width_around = rpf_plane_row(planes, step, step->by + 1, run.y);
  const RPF_PLANES float* known = rpf_plane_row(planes, step, step->mask, run.y);
  RPF_PLANES float* out = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) {
    const int own = blocked[x] > 0.0f;
    const float s = 1.0f + (own ? slope[x] : slope_around[x]), w = own ? width[x] : width_around[x];
    const float finest = rpf_spacing(planes, step, x, run.y) * (s * s), blur = w * w;
    out[x] = known[x] > 0.0f && blur > 0.0f ? step->scale / (blur > finest ? blur : finest) : 0.0f;
  }
}

// out: (9.23), the weight of a neighbor: of how far its surface is, 0 where its normal differs, where p is not to be
// filtered or a position is not known. in: positions; behind them `reach` planes of normals; by: rpf_shadow_falloff();
// mask: where positions are known; least: squared difference of normals that still counts.
RPF_INLINE void rpf_surface_weight(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const size_t stride = (size_t)step->width * (size_t)step->height;
  const rpf_pixel_run inside = rpf_neighbors_of(step, run);
  const RPF_PLANES float* falloff = rpf_plane_row(planes, step, step->by, run.y);
  RPF_PLANES float* weight = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) weight[x] = 0.0f;
  if (inside.x0 >= inside.x1) return;
  const RPF_PLANES float* here = rpf_plane_row(planes, step, step->mask, run.y);
  const RPF_PLANES float* there = rpf_plane_row(planes, step, step->mask, inside.y);
  const size_t own_row = (size_t)run.y * (size_t)step->width, other_row = (size_t)inside.y * (size_t)step->width;
  for (int x = inside.x0; x < inside.x1; ++x) {
    const size_t p = own_row + (size_t)x, q = other_row + (size_t)(x + step->dx);
    const float apart = rpf_squared_distance(planes, step->in, step->count, stride, p, q);
    const float turned = rpf_squared_distance(planes, step->in + step->count, (uint)step->reach, stride, p, q);
    const int alike = falloff[x] > 0.0f && turned <= step->least;
    weight[x] = alike ? here[x] * there[x + step->dx] * rpf_exp(-falloff[x] * apart) : 0.0f;
  }
}

// out: `count` planes from `in` on without the color of the surface: each divided by its own plane from `by` on, which
// counts as `least` at least.
RPF_INLINE void rpf_without_albedo(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* albedo = rpf_plane_row(planes, step, step->by + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = in[x] / (albedo[x] > step->least ? albedo[x] : step->least);
  }
}

// out: the same with that color again, where plane `mask` is above 0; elsewhere out stays.
RPF_INLINE void rpf_with_albedo(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const RPF_PLANES float* filtered = rpf_plane_row(planes, step, step->mask, run.y);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* albedo = rpf_plane_row(planes, step, step->by + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x)
      out[x] = filtered[x] > 0.0f ? in[x] * (albedo[x] > step->least ? albedo[x] : step->least) : out[x];
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
