// The learned estimator (docs/network.md): entry points and what the generated layers (src/opencl/layer_blocking.cpp)
// call. A step of src/opencl/estimate_steps.cpp each.
#include "rpf_network.h"

#include "network_launch.h"

// The formulas once more for the vectors of layers.
#undef RPF_REAL
#undef RPF_INT
#undef RPF_UINT
#undef RPF_SUMS
#undef RPF_WORDS
#undef RPF_TO_INT
#undef RPF_TO_REAL
#undef RPF_AS_REAL
#undef RPF_AS_INT
#define RPF_REAL float8
#define RPF_INT int8
#define RPF_UINT uint8
#define RPF_SUMS rpf_lanes8
#define RPF_WORDS rpf_words8
#define RPF_TO_INT(x) convert_int8(x)
#define RPF_TO_REAL(x) convert_float8(x)
#define RPF_AS_REAL(x) as_float8(x)
#define RPF_AS_INT(x) as_int8(x)
#include "elementwise.h"
#include "network_elementwise.h"

// ---- rows and their parts -------------------------------------------------------------------------------------------

static size_t row_at(const rpf_grid* grid, int y) { return (size_t)(y % grid->rows) * (size_t)grid->pitch; }

// Parts of an area one below the other, column after column of parts: a work-item takes some that lie together, so that
// what it reads around them is mostly its own.
static int row_of_part(const rpf_area* area, int i) { return area->first + i % (area->end - area->first); }
static int begin_of_part(const rpf_area* area, int i) { return i / (area->end - area->first) * area->part; }
static int end_of_part(const rpf_area* area, int i) { return min(begin_of_part(area, i) + area->part, area->width); }

// Of `parts` the work-item takes those from here on, up to where the next one begins.
static int share_of(int parts, size_t item) { return (int)((size_t)parts * item / get_global_size(0)); }
// No row: no parts either, whatever the rest of the area is; a rehearsal (src/opencl) hands over zeros.
static int parts_of(const rpf_area* area) {
  return area->first < area->end ? (area->end - area->first) * rpf_parts_of_row(area) : 0;
}
static int first_part(const rpf_area* area) { return share_of(parts_of(area), get_global_id(0)); }
static int end_part(const rpf_area* area) { return share_of(parts_of(area), get_global_id(0) + 1); }

// Repeats the edge beside a row of cells, where begin .. end - 1 touches it.
static void close_row(__global float* line, int stride, int begin, int end, int width) {
  for (int k = 0; begin == 0 && k < stride; ++k) line[k - stride] = line[k];
  for (int k = 0; end == width && k < stride; ++k) line[width * stride + k] = line[(width - 1) * stride + k];
}

// Also of no planes, as a rehearsal (src/opencl) has them.
static int plane_of(const rpf_grid* grid, int planes) { return grid->pitch / max(planes, 1); }

// Beside the planes of a row stands what adds nothing to a sum, whatever its weight: fma(0, -0, s) is s.
static void close_planes(__global float* row, int plane, int planes, int begin, int end, int width, float beside) {
  for (int k = 0; k < planes; ++k) {
    for (int x = 0; begin == 0 && x < RPF_MARGIN; ++x) row[k * plane + x] = beside;
    for (int x = RPF_MARGIN + width; end == width && x < plane; ++x) row[k * plane + x] = beside;
  }
}

// Has the line of memory around an address on its way into the caches; there may be nothing.
static void ask_for(__global const float* address) {
#ifdef RPF_AVX2  // Oclgrind does not know prefetches
  __builtin_prefetch((const void*)(size_t)address);
#else
  (void)address;
#endif
}

#include "transpose.cl"

#include "network_samples.cl"

#include "network_pixels.cl"

#include "network_sums.cl"

#include "network_passes.cl"

// ---- from level to level --------------------------------------------------------------------------------------------

// Means of 2x2 cells, those that exist. `stride` values a cell on both sides; `fine_width`, `fine_height` of what is
// read.
__kernel void halve(__global const float* in, __global float* out, const rpf_area area, const rpf_grid fine,
                    const rpf_grid coarse, const int fine_width, const int fine_height, const int stride) {
  for (int i = first_part(&area), last = end_part(&area); i < last; ++i) {
    const int y = row_of_part(&area, i), begin = begin_of_part(&area, i), end = end_of_part(&area, i);
    const int rows = min(fine_height - 2 * y, 2);
    __global const float* upper = in + row_at(&fine, 2 * y) + RPF_BORDER * stride;
    __global const float* lower = in + row_at(&fine, 2 * y + 1) + RPF_BORDER * stride;
    __global float* line = out + row_at(&coarse, y) + RPF_BORDER * stride;
    for (int x = begin; x < end; ++x) {
      const int columns = min(fine_width - 2 * x, 2);
      const float share = 1.0f / (float)(rows * columns);
      for (int k = 0; k < stride; k += 8) {
        const int at = 2 * x * stride + k;
        float8 sum = 0.0f;
        sum += vload8(0, upper + at);
        if (columns > 1) sum += vload8(0, upper + at + stride);
        if (rows > 1) sum += vload8(0, lower + at);
        if (rows > 1 && columns > 1) sum += vload8(0, lower + at + stride);
        vstore8(sum * share, 0, line + x * stride + k);
      }
    }
    close_row(line, stride, begin, end, area.width);
  }
}
