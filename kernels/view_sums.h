// What pixels make of what they are given one by one, view after view or point after point: the mean (algorithm.md,
// (11.7) and (12.6)).
#ifndef RPF_VIEW_SUMS_H
#define RPF_VIEW_SUMS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
#define RPF_SHARED
namespace rpf::kernel {
#else
#define RPF_SHARED __global
#endif

#define RPF_NOBODY 0xFFFFFFFFu

// Where pixels look samples up, and where they add them up: [sample][carried], [carried][pixel], [carried + 1][pixel].
typedef struct {
  const RPF_SHARED float* colors;
  const RPF_SHARED float* means;
  RPF_SHARED float* sums;
  size_t pixels;
  uint carried;
} rpf_view_sums;

// The sums are of how far samples are off from the pixel's mean, so that equal colors stay what they are; the last one
// counts.
RPF_INLINE void rpf_add_view(const rpf_view_sums* s, size_t pixel, uint sample) {
  if (sample == RPF_NOBODY) return;
  for (uint c = 0; c < s->carried; ++c)
    s->sums[c * s->pixels + pixel] += s->colors[(size_t)sample * s->carried + c] - s->means[c * s->pixels + pixel];
  s->sums[s->carried * s->pixels + pixel] += 1.0f;
}

RPF_INLINE float rpf_mean_of_views(float mean, float sum, float seen) { return seen > 0.0f ? mean + sum / seen : mean; }

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
