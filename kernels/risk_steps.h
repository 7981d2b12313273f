// Steps of the cross-bilateral filter that Stein's unbiased risk chooses the width of (algorithm.md, section 9.3).
#ifndef RPF_RISK_STEPS_H
#define RPF_RISK_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "plane_steps.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// (9.15): squared difference of a feature in units of its variance, which counts as `least` at least.
RPF_INLINE float rpf_feature_distance(float a, float b, float variance_a, float variance_b, float least) {
  const float variance = variance_a + variance_b;
  return (a - b) * (a - b) / (variance > least ? variance : least);
}

// out: (9.16) without the distance on the film: what the features say, 0 where p or q has no samples. in: `count`
// features; by: their variances; weights: 1 / (2 sigma^2) of each.
RPF_INLINE void rpf_feature_weight(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const rpf_pixel_run inside = rpf_neighbors_of(step, run);
  const int dx = step->dx;
  RPF_PLANES float* weight = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) weight[x] = 0.0f;
  if (inside.x0 >= inside.x1) return;
  for (uint k = 0; k < step->count; ++k) {
    const float scale = step->weights[k], least = step->least;
    const RPF_PLANES float* own = rpf_plane_row(planes, step, step->in + k, run.y);
    const RPF_PLANES float* other = rpf_plane_row(planes, step, step->in + k, inside.y);
    const RPF_PLANES float* own_variance = rpf_plane_row(planes, step, step->by + k, run.y);
    const RPF_PLANES float* other_variance = rpf_plane_row(planes, step, step->by + k, inside.y);
    for (int x = inside.x0; x < inside.x1; ++x)
      weight[x] += scale * rpf_feature_distance(own[x], other[x + dx], own_variance[x], other_variance[x + dx], least);
  }
  const RPF_PLANES float* here = rpf_plane_row(planes, step, step->mask, run.y);
  const RPF_PLANES float* there = rpf_plane_row(planes, step, step->mask, inside.y);
  for (int x = inside.x0; x < inside.x1; ++x) weight[x] = here[x] * there[x + dx] * rpf_exp(-weight[x]);
}

// out: (9.18), Stein's risk of a weighted mean, over the three colors. by: the sums of rpf_gather(), `count` and their
// weights; in: three variances of the unfiltered mean.
RPF_INLINE void rpf_risk(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  RPF_PLANES float* risk = rpf_plane_row(planes, step, step->out, run.y);
  const RPF_PLANES float* total = rpf_plane_row(planes, step, step->by + step->count, run.y);
  for (int x = run.x0; x < run.x1; ++x) risk[x] = 0.0f;
  for (uint c = 0; c < 3; ++c) {
    const RPF_PLANES float* sum = rpf_plane_row(planes, step, step->by + c, run.y);
    const RPF_PLANES float* variance = rpf_plane_row(planes, step, step->in + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) {
      const float own_share = 1.0f / (1.0f + total[x]), moved = sum[x] * own_share;
      risk[x] += moved * moved + variance[x] * (2.0f * own_share - 1.0f);
    }
  }
}

// out: of `reach` groups of `count` planes from `by` on the one whose plane from `in` on is smallest; the first of
// equals.
RPF_INLINE void rpf_choose_least(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const size_t stride = (size_t)step->width * (size_t)step->height;
  const uint groups = (uint)step->reach, count = step->count;
  const RPF_PLANES float* risk = rpf_plane_row(planes, step, step->in, run.y);
  const RPF_PLANES float* from = rpf_plane_row(planes, step, step->by, run.y);
  RPF_PLANES float* out = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) {
    uint least = 0;
    for (uint g = 1; g < groups; ++g) least = risk[g * stride + x] < risk[least * stride + x] ? g : least;
    for (uint c = 0; c < count; ++c) out[c * stride + x] = from[((size_t)least * count + c) * stride + x];
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
