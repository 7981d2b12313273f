// Steps of non-local means (algorithm.md, section 9.1).
#ifndef RPF_PATCH_STEPS_H
#define RPF_PATCH_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "plane_steps.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// (9.4): squared difference of two values less the variance that they have by chance, in units of that variance.
RPF_INLINE float rpf_relative_distance(float a, float b, float variance_a, float variance_b, float damping,
                                       float least) {
  const float smaller = variance_b < variance_a ? variance_b : variance_a;
  return ((a - b) * (a - b) - (variance_a + smaller)) / (least + damping * (variance_a + variance_b));
}

// out: sum of (9.4) over three colors between p and q, 0 where one of them has no samples; out + 1: 1 where both have.
// in: colors; by: their variances; scale: k^2; least: epsilon.
RPF_INLINE void rpf_patch_distance(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const rpf_pixel_run inside = rpf_neighbors_of(step, run);
  const float damping = step->scale, least = step->least;
  const int dx = step->dx;
  RPF_PLANES float* distance = rpf_plane_row(planes, step, step->out, run.y);
  RPF_PLANES float* both = rpf_plane_row(planes, step, step->out + 1, run.y);
  for (int x = run.x0; x < run.x1; ++x) distance[x] = both[x] = 0.0f;
  if (inside.x0 >= inside.x1) return;
  const RPF_PLANES float* here = rpf_plane_row(planes, step, step->mask, run.y);
  const RPF_PLANES float* there = rpf_plane_row(planes, step, step->mask, inside.y);
  for (int x = inside.x0; x < inside.x1; ++x) both[x] = here[x] * there[x + dx];
  for (uint c = 0; c < 3; ++c) {
    const RPF_PLANES float* own = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* other = rpf_plane_row(planes, step, step->in + c, inside.y);
    const RPF_PLANES float* own_variance = rpf_plane_row(planes, step, step->by + c, run.y);
    const RPF_PLANES float* other_variance = rpf_plane_row(planes, step, step->by + c, inside.y);
    for (int x = inside.x0; x < inside.x1; ++x)
      distance[x] += both[x] * rpf_relative_distance(own[x], other[x + dx], own_variance[x], other_variance[x + dx],
                                                     damping, least);
  }
}

// out: (9.5) and (9.6), the weight of a patch, 0 where p or q has no samples; out + 1 and out + 2 are used for sums.
// in: rows' sums of what rpf_patch_distance() made; by: whether p and q have samples.
RPF_INLINE void rpf_patch_weight(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  rpf_sum_columns(planes, step, run, step->in, step->out + 1);
  rpf_sum_columns(planes, step, run, step->in + 1, step->out + 2);
  RPF_PLANES float* weight = rpf_plane_row(planes, step, step->out, run.y);
  const RPF_PLANES float* distance = rpf_plane_row(planes, step, step->out + 1, run.y);
  const RPF_PLANES float* pairs = rpf_plane_row(planes, step, step->out + 2, run.y);
  const RPF_PLANES float* both = rpf_plane_row(planes, step, step->by, run.y);
  for (int x = run.x0; x < run.x1; ++x) {
    const float mean = distance[x] / (3.0f * (pairs[x] > 0.0f ? pairs[x] : 1.0f));
    weight[x] = both[x] * rpf_exp(mean > 0.0f ? -mean : 0.0f);
  }
}

// out: (9.7), the mean weight of the patches that hold p, 0 below `least`; out + 1 is used for sums.
// in: rows' sums of the weights; by: whether p and q have samples; mask: how many pairs of the patch have.
RPF_INLINE void rpf_patch_share(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const float least = step->least;
  rpf_sum_columns(planes, step, run, step->in, step->out + 1);
  RPF_PLANES float* share = rpf_plane_row(planes, step, step->out, run.y);
  const RPF_PLANES float* sum = rpf_plane_row(planes, step, step->out + 1, run.y);
  const RPF_PLANES float* both = rpf_plane_row(planes, step, step->by, run.y);
  const RPF_PLANES float* pairs = rpf_plane_row(planes, step, step->mask, run.y);
  for (int x = run.x0; x < run.x1; ++x) {
    const float mean = both[x] * (sum[x] / (pairs[x] > 0.0f ? pairs[x] : 1.0f));
    share[x] = mean < least ? 0.0f : mean;
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
