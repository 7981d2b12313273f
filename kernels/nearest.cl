// Pixels' columns in the space of a frame's samples on a device: the entry point.
#include "nearest.h"

#define RPF_RUN_PIXELS 32  // a work-item's part of a row

// Rows row .. end - 1 of the frame.
__kernel void integrate_rows(const rpf_columns columns, const rpf_point point, __global const uint* axis,
                             __global const float* split, __global const uint* first, __global const float* place,
                             __global const uint* sample, __global const float* metric, __global const float* colors,
                             __global const float* means, __global float* sums, int row, int end) {
  const rpf_sample_tree tree = {axis, split, first, place, sample, metric};
  const rpf_view_sums to = {colors, means, sums, (size_t)columns.width * (size_t)columns.height, columns.carried};
  const int parts = (columns.width + RPF_RUN_PIXELS - 1) / RPF_RUN_PIXELS;
  for (int i = (int)get_global_id(0); i < parts * (end - row); i += (int)get_global_size(0)) {
    const int x0 = i % parts * RPF_RUN_PIXELS, x1 = min(x0 + RPF_RUN_PIXELS, columns.width);
    rpf_integrate_run(&columns, &point, &tree, &to, row + i / parts, x0, x1);
  }
}
