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

// Samples lie in rows of so many, without a border.
#define RPF_SAMPLE_ROW 64

// What is computed of a sample: [sample][RPF_SEEN].
#define RPF_SEEN 16
#define RPF_SEEN_INPUTS 0     // 6: inputs 0 to 5
#define RPF_SEEN_COLOR 6      // 3: c
#define RPF_SEEN_LUMINANCE 9  // 1
#define RPF_SEEN_BASE 10      // 3: a

// Rows of a level that are on the device: row y lies at y % rows.
typedef struct {
  int rows;
  int pitch;  // floats a row
} rpf_grid;

// Rows first .. end - 1 of a level are made. Work-items take parts of rows in turn.
typedef struct {
  int width, height;  // of the level, cells
  int first, end;
  int part;  // cells of a part, a multiple of 16
} rpf_area;

// A layer. Of records `own` says how many samples there are, and the floats of a record.
typedef struct {
  rpf_area area;
  rpf_grid coarse, own, out;
  int inputs;  // columns of records
} rpf_layer;

// Some pixels of a window of the frame, row by row, whose samples lie side by side in the frame: records, others,
// weights and what is made of samples begin with the first of them.
typedef struct {
  int first, end;     // pixels of the window
  int x, width;       // the window's columns in the frame
  int frame_width;    //
  int first_row;      // of the window: first_sample begins with its first pixel in the frame
  uint first_sample;  // in the frame
  uint samples;
  int variables;    // floats of a record
  int has_albedo;   //
  int has_weights;  // of the file
  float exposure, weight_scale;
  uint features, stride;  // of a sample: values of sample2, floats from one sample to the next
  int carried;            //
} rpf_chunk;

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
