// The light field of a frame's samples on a device: entry points.
#include "views.h"

#define RPF_RUN_PIXELS 32  // a work-item's part of a row

__kernel void move_samples(__global const float* tracks, const rpf_lens lens, const rpf_view view,
                           __global float* places, __global float* ends, uint samples) {
  for (uint i = (uint)get_global_id(0); i < samples; i += (uint)get_global_size(0))
    rpf_move(tracks + RPF_TRACK * (size_t)i, &lens, &view, places + RPF_PLACE * (size_t)i, ends + RPF_ENDS * (size_t)i);
}

// Rows row .. end - 1 of the frame.
__kernel void see_rows(const rpf_light_field field, const rpf_view view, __global const uint* first,
                       __global const float* place, __global const uint* sample, __global const float* ends,
                       __global const float* colors, __global const float* means, __global float* sums, int row,
                       int end) {
  rpf_cells cells;
  cells.first = first;
  cells.place = place;
  cells.sample = sample;
  const rpf_view_sums to = {colors, means, sums, (size_t)field.width * (size_t)field.height, field.carried};
  const int parts = (field.width + RPF_RUN_PIXELS - 1) / RPF_RUN_PIXELS;
  for (int i = (int)get_global_id(0); i < parts * (end - row); i += (int)get_global_size(0)) {
    const int x0 = i % parts * RPF_RUN_PIXELS, x1 = min(x0 + RPF_RUN_PIXELS, field.width);
    rpf_see_run(&field, &view, &cells, ends, &to, row + i / parts, x0, x1);
  }
}
