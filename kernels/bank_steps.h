// Steps of the bank of Gaussians (algorithm.md, section 9.2). A level is a picture at one width: `count` averaged
// planes, the mean number of samples, three variances.
#ifndef RPF_BANK_STEPS_H
#define RPF_BANK_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "plane_steps.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// out: along a row, sums of weights[|i|] * value of `count` planes from `in` on, over the pixels that have samples; in
// the plane behind them the sum of the weights.
RPF_INLINE void rpf_kernel_rows(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const int width = step->width;
  const RPF_PLANES float* mask = rpf_plane_row(planes, step, step->mask, run.y);
  for (uint c = 0; c <= step->count; ++c) {
    const RPF_PLANES float* in = c < step->count ? rpf_plane_row(planes, step, step->in + c, run.y) : mask;
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = 0.0f;
    for (int i = -step->reach; i <= step->reach; ++i) {
      const float weight = step->weights[i < 0 ? -i : i];
      const int first = run.x0 > -i ? run.x0 : -i, end = run.x1 < width - i ? run.x1 : width - i;
      for (int x = first; x < end; ++x) out[x] += weight * mask[x + i] * in[x + i];
    }
  }
}

// out: the same along columns, of `count` + 1 planes that rpf_kernel_rows() made.
RPF_INLINE void rpf_kernel_columns(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const int first = run.y < step->reach ? -run.y : -step->reach;
  const int last = run.y + step->reach < step->height ? step->reach : step->height - 1 - run.y;
  for (uint c = 0; c <= step->count; ++c) {
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = 0.0f;
    for (int i = first; i <= last; ++i) {
      const float weight = step->weights[i < 0 ? -i : i];
      const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y + i);
      for (int x = run.x0; x < run.x1; ++x) out[x] += weight * in[x];
    }
  }
}

// out: `count` sums from `in` on, divided by the sum of weights in plane `by`, or by its square where `reach` is 2.
RPF_INLINE void rpf_normalize_planes(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const int squared = step->reach == 2;
  const RPF_PLANES float* total = rpf_plane_row(planes, step, step->by, run.y);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* in = rpf_plane_row(planes, step, step->in + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) {
      const float by = squared ? total[x] * total[x] : total[x];
      out[x] = by > 0.0f ? in[x] / by : 0.0f;
    }
  }
}

// (9.12): how much the squared bias of a wider Gaussian exceeds that of a finer one, held against the variance that it
// saves.
RPF_INLINE float rpf_loss(float fine, float coarse, float fine_variance, float coarse_variance, float trust,
                          float ratio) {
  return trust * (ratio * ((fine - coarse) * (fine - coarse))) - (fine_variance - coarse_variance);
}

// out: 1 where the step from level `in` to level `by` would not pay, else 0. mask: mean number of samples; scale: beta
// of (9.12); least: zeta of (9.13).
RPF_INLINE void rpf_stop(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const float ratio = step->scale, most_trust = step->least;
  const RPF_PLANES float* samples = rpf_plane_row(planes, step, step->mask, run.y);
  RPF_PLANES float* stop = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) stop[x] = 0.0f;
  for (uint c = 0; c < 3; ++c) {
    const RPF_PLANES float* fine = rpf_plane_row(planes, step, step->in + c, run.y);
    const RPF_PLANES float* coarse = rpf_plane_row(planes, step, step->by + c, run.y);
    const uint variance = step->count + 1 + c;
    const RPF_PLANES float* fine_variance = rpf_plane_row(planes, step, step->in + variance, run.y);
    const RPF_PLANES float* coarse_variance = rpf_plane_row(planes, step, step->by + variance, run.y);
    for (int x = run.x0; x < run.x1; ++x) {
      const float trust = samples[x] > 1.0f ? most_trust * (1.0f - 1.0f / samples[x]) : 0.0f;
      stop[x] += rpf_loss(fine[x], coarse[x], fine_variance[x], coarse_variance[x], trust, ratio);
    }
  }
  for (int x = run.x0; x < run.x1; ++x) stop[x] = stop[x] >= 0.0f ? 1.0f : 0.0f;
}

// (9.14): a stop holds where most of those around it, itself left out, say the same; a pixel without others decides
// alone.
RPF_INLINE float rpf_agreed_stop(float stop, float sum, float total) {
  const float others = total - 1.0f;
  return stop > 0.0f && (others < 1e-5f || (sum - stop) / others >= 0.5f) ? 1.0f : 0.0f;
}

// out: 1 where no stop was met yet, kept up to date, and behind it `count` planes: the picture, which takes level `by`
// there. in: the stops, and behind them their weighted sums as of rpf_kernel_columns(), with a weight of 1 in the
// middle.
RPF_INLINE void rpf_choose_scale(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  const RPF_PLANES float* stop = rpf_plane_row(planes, step, step->in, run.y);
  const RPF_PLANES float* sum = rpf_plane_row(planes, step, step->in + 1, run.y);
  const RPF_PLANES float* total = rpf_plane_row(planes, step, step->in + 2, run.y);
  RPF_PLANES float* open = rpf_plane_row(planes, step, step->out, run.y);
  for (int x = run.x0; x < run.x1; ++x) open[x] *= 1.0f - rpf_agreed_stop(stop[x], sum[x], total[x]);
  for (uint c = 0; c < step->count; ++c) {
    const RPF_PLANES float* level = rpf_plane_row(planes, step, step->by + c, run.y);
    RPF_PLANES float* out = rpf_plane_row(planes, step, step->out + 1 + c, run.y);
    for (int x = run.x0; x < run.x1; ++x) out[x] = open[x] > 0.0f ? level[x] : out[x];
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
