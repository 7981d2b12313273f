// The device's view of the samples, and the scratch memory of one work-item.
//
// Compiled in (-D): RPF_VARIABLES, RPF_RANDOM, RPF_FEATURES, RPF_BINS, RPF_CARRIED of the plan; RPF_REJECTING, how many
// features have to be looked at to reject a candidate; RPF_SAMPLES, the samples of every pixel, 0 where they vary;
// RPF_MISSING, 1 where the frame has missing values.
#include "pass.h"
#include "rpf_math.h"
#include "trace_layout.h"

#define RPF_CHUNKS ((RPF_VARIABLES + RPF_CARRIED + RPF_LANES - 1) / RPF_LANES)  // vectors that hold a record and its c'
#define RPF_FEATURE_CHUNKS ((RPF_FEATURES + RPF_LANES - 1) / RPF_LANES)
#define RPF_REJECTING_CHUNKS ((RPF_REJECTING + RPF_LANES - 1) / RPF_LANES)
#define RPF_POSITION 3  // first position coordinate of a record
#define RPF_FIRST_FEATURE (5 + RPF_RANDOM)
#define RPF_PAIRS (3 * (2 + RPF_RANDOM + RPF_FEATURES) + RPF_FEATURES * (2 + RPF_RANDOM))  // rpf_pairs()
#define RPF_HALF_BINS ((RPF_BINS - 1) / 2)
#define RPF_BIN_VECTORS ((RPF_BINS + RPF_BINS_AT_ONCE - 1) / RPF_BINS_AT_ONCE)
// Of a distance, at most: position (section 8), colors, features.
#define RPF_COORDINATES (5 + RPF_FEATURES)
#define RPF_FIRST_COLOR RPF_COORDINATES                  // column of c'
#define RPF_COLUMNS (RPF_COORDINATES + RPF_CARRIED + 1)  // and one for what is not needed
// Own samples that are filtered together: a neighbor's coordinates are read once for all of them.
#define RPF_BATCH (RPF_SAMPLES > 0 && RPF_SAMPLES < 4 ? RPF_SAMPLES : 4)
#define RPF_NO_SAMPLE 0xFFFFFFFFu

#define RPF_LANE_NUMBERS ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

// The band of the frame that is on the device, and the tables of plan and pass. Pixels and samples keep the numbers
// that they have in the whole frame.
typedef struct {
  __global const uint* first_sample;        // [pixel + 1]
  __global const float16* chunks;           // [RPF_CHUNKS][sample] records, in the order of place_of(), and c'
  __global const char* offsets;             // [65536] of the draws
  __global const uint* draws;               // [samples of a pixel] candidates to draw
  __global const int* entropy;              // [n] S n log2 n
  __global const float* rejection_factor;   // [RPF_FEATURE_CHUNKS * RPF_LANES] H
  __global const float* minimum_tolerance;  // [RPF_FEATURE_CHUNKS * RPF_LANES] a; infinity: takes no part
} Frame;

// Column and row of a pixel in the frame.
static int2 position_of(const rpf_pass* pass, uint pixel) {
  const uint y = pixel / (uint)pass->width;
  return (int2)((int)(pixel - y * (uint)pass->width), (int)y);
}

// On the device a record begins with its features, those that can reject it first: to test a candidate is to read one
// cache line in most cases. Behind the variables stand the RPF_CARRIED values of c', so that what is averaged comes
// along.
static uint place_of(uint variable) {
  return variable < RPF_FIRST_FEATURE ? variable + RPF_FEATURES : variable - RPF_FIRST_FEATURE;
}

static uint variable_at(uint place) { return place < RPF_FEATURES ? place + RPF_FIRST_FEATURE : place - RPF_FEATURES; }

// Scratch of a work-item. A stretch is what a weighted sum adds up before it is added to a total (numeric.h).
typedef struct {
  __global uint* candidates;  // [RPF_DRAWN_AT_ONCE]
  __global uint* neighbors;   // [capacity]
  __global float16* records;  // [RPF_CHUNKS][capacity] of the neighbors; in box.cl [RPF_COLUMNS][capacity / RPF_LANES]
  __global ulong8* planes;    // [RPF_VARIABLES][words][RPF_BIN_VECTORS] one bit a neighbor and bin (statistics.cl)
  __global float16* columns;  // [RPF_COLUMNS][RPF_STRETCH] a stretch of neighbors, RPF_LANES in a vector (weighting.cl)
  __global float16* sums;  // [own samples][1 + RPF_CARRIED] of weights and weighted colors, and one more (weighting.cl)
} Slot;

// Every intermediate value of one pixel, where it is asked for.
typedef struct {
  __global float* values;     // as trace_layout.h says; null: no trace
  __global uint* histograms;  // [pair][RPF_BINS][RPF_BINS]
  rpf_trace_layout at;
} Trace;
