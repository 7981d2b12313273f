// Steps that several methods are made of: sums of boxes, weighted means of neighbors.
#ifndef RPF_PLANE_STEPS_H
#define RPF_PLANE_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "pixel_step.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// The pixels x0 .. x1 - 1 of row y.
typedef struct {
  int y, x0, x1;
} rpf_pixel_run;

RPF_INLINE RPF_PLANES float* rpf_plane_row(RPF_PLANES float* planes, const rpf_pixel_step* step, uint plane, int y) {
  return planes + ((size_t)plane * (size_t)step->height + (size_t)y) * (size_t)step->width;
}

// The neighbors of a run that are inside the picture: those of x0 .. x1 - 1 of the result, in row y.
RPF_INLINE rpf_pixel_run rpf_neighbors_of(const rpf_pixel_step* step, rpf_pixel_run run) {
  rpf_pixel_run inside;
  inside.y = run.y + step->dy;
  const int first = step->dx < 0 ? -step->dx : 0, end = step->width - (step->dx > 0 ? step->dx : 0);
  inside.x0 = run.x0 > first ? run.x0 : first;
  inside.x1 = run.x1 < end ? run.x1 : end;
  if (inside.y < 0 || inside.y >= step->height || inside.x1 < inside.x0) inside.x0 = inside.x1 = run.x1;
  return inside;
}

// out: sums of `count` planes from `in` on over 2 reach + 1 pixels of a row, as far as the picture goes.
RPF_INLINE void rpf_box_rows(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const int reach = step->reach, width = step->width;
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = 0.0f;
    for (int i = -reach; i <= reach; ++i) {
      const int first = run.x0 > -i ? run.x0 : -i, end = run.x1 < width - i ? run.x1 : width - i;
      for (int x = first; x < end; ++x) out[x] += in[x + i];
    }
  }
}

// Sums of a plane over 2 reach + 1 pixels of a column, into row y of another.
RPF_INLINE void rpf_sum_columns(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run, uint from,
                                uint to) {
  RPF_PLANES float* out = rpf_plane_row(planes, step, to, run.y);
  for (int x = run.x0; x < run.x1; ++x) out[x] = 0.0f;
  const int first = run.y - step->reach < 0 ? 0 : run.y - step->reach;
  const int last = run.y + step->reach < step->height ? run.y + step->reach : step->height - 1;
  for (int y = first; y <= last; ++y) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, from, y);
    for (int x = run.x0; x < run.x1; ++x) out[x] += in[x];
  }
}

// Adds to `count` planes from `out` on w (value at q - value at p), and w to the plane behind them: what is averaged is
// how far neighbors are off, so that equal values stay what they are. in: values; w: plane `by` times `scale`.
RPF_INLINE void rpf_gather(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const rpf_pixel_run inside = rpf_neighbors_of(step, run);
  const int dx = step->dx;
  const float scale = step->scale;
  if (inside.x0 >= inside.x1) return;
  const RPF_PLANES float* weight = rpf_plane_row(planes, step, step->by, run.y);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* own = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* other = rpf_plane_row(planes, step, step->in + c, inside.y);
    RPF_PLANES float* sum = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = inside.x0; x < inside.x1; ++x) sum[x] += scale * weight[x] * (other[x + dx] - own[x]);
  }
  RPF_PLANES float* total = rpf_plane_row(planes, step, step->out + step->count, run.y);
  for (int x = inside.x0; x < inside.x1; ++x) total[x] += scale * weight[x];
}

// out: the weighted mean that rpf_gather() prepared, p itself with a weight of 1. in: values; by: its sums.
RPF_INLINE void rpf_average(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const RPF_PLANES float* total = rpf_plane_row(planes, step, step->by + step->count, run.y);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* sum = rpf_plane_row(planes, step, step->by + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = in[x] + sum[x] / (1.0f + total[x]);
  }
}

// out: (9.9), the mean of two groups of `count` planes, from `in` and from `in + count` on, with the weights that stand
// in the planes `by` and `by + 1`.
RPF_INLINE void rpf_mix(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const RPF_PLANES float* a = rpf_plane_row(planes, step, step->by, run.y);
  const RPF_PLANES float* b = rpf_plane_row(planes, step, step->by + 1, run.y);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* first = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* second = rpf_plane_row(planes, step, step->in + step->count + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) {
      const float total = a[x] + b[x];
      out[x] = first[x] + (second[x] - first[x]) * (b[x] / (total > 0.0f ? total : 1.0f));
    }
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
