// What passes between driver, host and device for one pass: plain data with one layout on both sides.
#ifndef RPF_PASS_H
#define RPF_PASS_H
// NOLINTBEGIN(modernize-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// What the filter found at a pixel; the driver averages it for the report.
typedef struct {
  uint drawn;             // candidates drawn
  uint neighbors;         // N; 0: not filtered or no samples
  float fraction_random;  // W_c^r
  float alpha, beta;      // means over the channels
} rpf_pixel_statistics;

// One launch: the numbers of the plan that are not compiled in, and the pixels to filter.
typedef struct {
  int width, height;            // of the frame, pixels
  int tile_x, tile_y;           // frame coordinates
  int tile_width, tile_height;  // pixels
  uint first_pixel;             // the first pixel and the first sample of the band that is on the device
  uint first_sample;            //
  uint samples;                 // of the band
  uint seed, pass, attempts;    // of the draws (section 3)
  uint capacity;                // neighbors and own samples that a scratch slot holds
  uint most_samples;            //
  int entropy_slack;            // units that cannot be told from 0 (section 5)
  float nats_per_unit;          //
  float information_bias;       //
  float alpha_factor, growth;   // of (T 5.9)
  float noise;                  // of (T 5.10)
  int outlier_step;             // 1: section 7 follows
  int reach;                    // of the box of section 8: (b - 1) / 2
  uint coordinates;             // of its distances
  uint first_own, end_own;      // of a long pixel: the own samples of this launch (weighting.cl)
  uint first_block, end_block;  // and the neighbors that it looks at to explain it, in blocks of RPF_LANES
} rpf_pass;

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*)
#endif
