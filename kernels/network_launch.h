// What host and device share about the learned estimator's launches: plain data with one layout on both sides.
#ifndef RPF_NETWORK_LAUNCH_H
#define RPF_NETWORK_LAUNCH_H
// NOLINTBEGIN(modernize-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// Cells of a level lie side by side, with so many at either end of a row that repeat the edge: a convolution need not
// look where the frame ends.
#define RPF_BORDER 1

// Layers are computed for so many cells at once, and rows have room for a multiple of it between their borders.
#define RPF_CELLS 8

// Values that passes read lie in planes, [row][plane][pixel], with so many pixels at either end that do not count.
#define RPF_MARGIN 16

// Pixels of a pass that a pixel is weighed with, those further on in its row and in the rows below: 2 and 10.
#define RPF_PASS_PAIRS 12

// Samples of a part of a row of pixels go through the network so many at once, a multiple of RPF_LANES.
#define RPF_SAMPLES_AT_ONCE 64

// What is computed of a sample, and its radiance: [sample][RPF_SEEN]. Sums are made of what stands from RPF_SEEN_SUMMED
// on.
#define RPF_SEEN 16
#define RPF_SEEN_INPUTS 0     // 6: inputs 0 to 5
#define RPF_SEEN_COLOR 6      // 3: c
#define RPF_SEEN_LUMINANCE 9  // 1
#define RPF_SEEN_BASE 10      // 3: a
#define RPF_SEEN_RADIANCE 13  // 3: of the record, as it is
#define RPF_SEEN_SUMMED 8     // 8

// Rows of a level that are on the device: row y lies at y % rows.
typedef struct {
  int rows;
  int pitch;  // floats a row
} rpf_grid;

// Rows first .. end - 1 of a level are made. Work-items take parts of rows in turn.
typedef struct {
  int width, height;  // of the level, cells
  int first, end;
  int part;  // cells of a part, a multiple of 16 where they are computed side by side
} rpf_area;

RPF_INLINE int rpf_parts_of_row(const rpf_area* area) { return (area->width + area->part - 1) / area->part; }

// A layer.
typedef struct {
  rpf_area area;
  rpf_grid coarse, own, out;
} rpf_layer;

// Samples of some rows of a window: records, others and weights begin with the first of them, first_sample with the
// first pixel of these rows in the window.
typedef struct {
  rpf_area area;             // pixels of the window
  int first_part, end_part;  // of the area: those of this launch
  int frame_width;           // entries of first_sample from one row to the next
  uint first_sample;         // in the frame
  uint samples;              //
  int variables;             // floats of a record
  int inputs;                // columns of records that the network sees
  int has_albedo;            //
  int has_weights;           // of the file
  float exposure, weight_scale;
  int carried;
  int is_traced;  // whether somebody wants what is made of samples on the way
} rpf_samples;

// Columns x .. x + width - 1 of a window, rows from y on: what is wanted of it.
typedef struct {
  int x, y, width;
} rpf_region;

// A pass.
typedef struct {
  rpf_area area;
  rpf_grid weights, in, out;
  int dilation;
  int values;  // planes of `in`
} rpf_network_pass;

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*)
#endif
