// The methods with fixed weights (section 8): the neighbors of a pixel are all samples in its box.
//
// The samples of pixels that lie side by side follow each other in the memory: a row of a box is one run of them, in
// every column of the band. So a neighborhood is copied run by run, a vector at a time, and then filtered as in
// section 6.
#define RPF_PHASES 5  // all: neighborhood.cl asks

#include "frame.cl"
#include "neighborhood.cl"

#define RPF_MOST_RUNS 257  // the own samples, the two parts that these leave of their row, and 254 other rows

// A neighborhood: the own samples, then the others of the box row by row.
typedef struct {
  uint samples, runs;
  uint first[RPF_MOST_RUNS], count[RPF_MOST_RUNS];
} Box;

// Samples first .. last - 1.
static void add_run(Box* box, uint first, uint last) {
  box->first[box->runs] = first;
  box->count[box->runs] = last - first;
  box->samples += last - first;
  ++box->runs;
}

static void gather_box(const Frame* frame, const rpf_pass* pass, uint pixel, Box* box) {
  const int2 at = position_of(pass, pixel);
  const int x = at.x, y = at.y;
  const int left = max(x - pass->reach, 0), right = min(x + pass->reach, pass->width - 1);
  const uint own = first_sample_of(frame, pass, pixel), after_own = own + samples_of(frame, pass, pixel);
  box->samples = box->runs = 0;
  add_run(box, own, after_own);
  for (int row = max(y - pass->reach, 0); row <= min(y + pass->reach, pass->height - 1); ++row) {
    const uint last = (uint)(row * pass->width + right);
    uint begin = first_sample_of(frame, pass, (uint)(row * pass->width + left));
    if (row == y) {
      add_run(box, begin, own);
      begin = after_own;
    }
    add_run(box, begin, first_sample_of(frame, pass, last) + samples_of(frame, pass, last));
  }
}

// What the own samples are filtered with: the coordinates of the pass. The slot has them, unscaled, and c' of all
// neighbors as columns.
typedef struct {
  uint own, neighbors;
  uint count;  // of coordinates
  __global const uint* variable;
  __global const float* scale;
} Means;

static __global float16* column_of(const rpf_pass* pass, const Slot* slot, uint column) {
  return slot->records + column * (pass->capacity / RPF_LANES);
}

// A stretch of neighbors, from block `first` on: the scaled coordinates and c'. Behind the last neighbor stands the
// first one's c': it has no weight, and it is inside every range.
static void fill_columns(const rpf_pass* pass, const Slot* slot, const Means* means, uint first, uint last) {
  for (uint a = 0; a < means->count; ++a) {
    __global const float16* column = column_of(pass, slot, a);
    for (uint block = first; block < last; ++block)
      slot->columns[a * RPF_STRETCH + block - first] = column[block] * means->scale[a];
  }
  for (uint c = RPF_FIRST_COLOR; c < RPF_FIRST_COLOR + RPF_CARRIED; ++c) {
    __global const float16* column = column_of(pass, slot, c);
    for (uint block = first; block < last; ++block) {
      const int16 is_neighbor = RPF_LANE_NUMBERS < (int)(means->neighbors - block * RPF_LANES);
      slot->columns[c * RPF_STRETCH + block - first] = is_neighbor ? column[block] : column[0].s0;
    }
  }
}

// The scaled coordinates of a batch of own samples. Behind the last own sample that one is repeated.
static void load_own(const rpf_pass* pass, const Slot* slot, const Means* means, uint begin,
                     float (*own)[RPF_COORDINATES]) {
  for (uint i = 0; i < RPF_BATCH; ++i)
    for (uint a = 0; a < means->count; ++a)
      own[i][a] = ((__global const float*)column_of(pass, slot, a))[min(begin + i, means->own - 1)] * means->scale[a];
}

#include "weighting.cl"

// One column of the band for the samples of the box. What is copied too much behind a run is overwritten by the next
// one, and behind the last by nothing: both columns have room for a vector more.
static void copy_column(const Box* box, __global const float* from, const rpf_pass* pass, __global float16* column) {
  __global float* to = (__global float*)column;
  for (uint r = 0; r < box->runs; ++r) {
    __global const float* run = from + (box->first[r] - pass->first_sample);
    for (uint i = 0; i < box->count[r]; i += RPF_LANES) vstore16(vload16(0, run + i), 0, to + i);
    to += box->count[r];
  }
}

static void trace_box(const Box* box, const Slot* slot) {
  uint j = 0;
  for (uint r = 0; r < box->runs; ++r)
    for (uint i = 0; i < box->count[r]; ++i) slot->neighbors[j++] = box->first[r] + i;
}

// The own samples of a pixel that has some. `columns`: of the band, as lay_out_columns() makes them. Returns N.
static uint filter_pixel(const Frame* frame, const rpf_pass* pass, uint pixel, __global const float* columns,
                         Means* means, const Slot* slot, const Trace* trace, __global float* out) {
  Box box;
  gather_box(frame, pass, pixel, &box);
  means->own = samples_of(frame, pass, pixel);
  means->neighbors = box.samples;
  for (uint a = 0; a < means->count; ++a)
    copy_column(&box, columns + (size_t)means->variable[a] * pass->samples, pass, column_of(pass, slot, a));
  for (uint c = 0; c < RPF_CARRIED; ++c)
    copy_column(&box, columns + (size_t)(RPF_VARIABLES + c) * pass->samples, pass,
                column_of(pass, slot, RPF_FIRST_COLOR + c));
  filter_samples(pass, slot, means, trace, out);
  if (!trace->values) return box.samples;
  trace_box(&box, slot);
  for (uint i = 0; i < means->own * RPF_CARRIED; ++i) trace->values[trace->at.filtered + i] = out[i];
  return box.samples;
}

// Lays the records and c' of a band out as filter_box reads them: [RPF_VARIABLES + RPF_CARRIED][sample].
__kernel void lay_out_columns(__global const float* records, __global const float* colors, __global float* columns,
                              uint samples, __global const float* centers) {
  for (uint s = (uint)get_global_id(0); s < samples; s += (uint)get_global_size(0)) {
    for (uint v = 0; v < RPF_VARIABLES; ++v)
      columns[(size_t)v * samples + s] = rpf_centered(records[(size_t)s * RPF_VARIABLES + v], centers[v]);
    for (uint c = 0; c < RPF_CARRIED; ++c)
      columns[(size_t)(RPF_VARIABLES + c) * samples + s] = colors[(size_t)s * RPF_CARRIED + c];
  }
}

// Filters the pixels of a tile; arguments as of filter_tile. `variables`, `scales`: of the pass's coordinates.
__kernel void filter_box(__global const uint* first_sample, __global const float* columns,
                         __global const uint* variables, __global const float* scales, __global uint* neighbors,
                         __global float16* copies, __global float16* slot_columns, __global float16* sums,
                         __global float* next_colors, __global rpf_pixel_statistics* statistics,
                         __global float* trace_values, const rpf_pass pass) {
  const size_t item = get_global_id(0);
  Frame frame;
  Slot slot;
  Trace trace;
  Means means;
  frame.first_sample = first_sample;
  slot.neighbors = neighbors + item * pass.capacity;
  slot.records = copies + item * RPF_COLUMNS * (pass.capacity / RPF_LANES);
  slot.columns = slot_columns + item * RPF_COLUMNS * RPF_STRETCH;
  slot.sums = sums + item * (pass.most_samples * (1 + RPF_CARRIED) + 1);
  means.count = pass.coordinates;
  means.variable = variables;
  means.scale = scales;
  trace.values = trace_values;
  trace.at = rpf_lay_out_trace(RPF_RANDOM, RPF_FEATURES, RPF_CARRIED,
                               samples_of(&frame, &pass, (uint)(pass.tile_y * pass.width + pass.tile_x)));
  for (uint i = (uint)item; i < (uint)(pass.tile_width * pass.tile_height); i += (uint)get_global_size(0)) {
    const uint row = i / (uint)pass.tile_width;
    const uint pixel =
        ((uint)pass.tile_y + row) * (uint)pass.width + (uint)pass.tile_x + i - row * (uint)pass.tile_width;
    rpf_pixel_statistics found = {0, 0, 0.0f, 0.0f, 0.0f};
    if (samples_of(&frame, &pass, pixel) > 0) {
      const uint first = first_sample_of(&frame, &pass, pixel) - pass.first_sample;
      found.neighbors =
          filter_pixel(&frame, &pass, pixel, columns, &means, &slot, &trace, next_colors + (size_t)first * RPF_CARRIED);
    }
    statistics[pixel - pass.first_pixel] = found;
  }
}
