// The whole filter of a pixel (algorithm 1, sections 3 to 7), and the kernel that runs it over a tile.
//
// One work-item filters one pixel after the other, with a scratch slot of its own and no barriers. The host starts as
// many as the device can run at once (src/opencl/opencl_backend.cpp).
// How many phases of a pixel run, of five. Only the benchmarks compile less than all, to know what each takes.
#ifndef RPF_PHASES
#define RPF_PHASES 5
#endif
// 1: also what explains a pixel, which only `rpf explain` asks for.
#ifndef RPF_EXPLAIN
#define RPF_EXPLAIN 0
#endif

#include "target.cl"

// All that a pixel takes, down to the kernels.
#ifdef RPF_AVX512
#pragma clang attribute push(RPF_TARGET, apply_to = function)
#endif

#include "frame.cl"
#include "neighborhood.cl"
#include "transpose.cl"

#include "bit_counts.cl"
#include "statistics.cl"

#include "coordinates.cl"
#include "weighting.cl"

static void trace_vectors(const Trace* trace, uint at, const float16* values, int count) {
  for (int c = 0; c < count; ++c) vstore16(values[c], c, trace->values + at);
}

static void trace_floats(const Trace* trace, uint at, const float* values, uint count) {
  for (uint i = 0; i < count; ++i) trace->values[at + i] = values[i];
}

static void trace_moments(const Trace* trace, const OwnMoments* moments) {
  trace_vectors(trace, trace->at.own_mean, moments->mean, RPF_FEATURE_CHUNKS);
  trace_vectors(trace, trace->at.own_deviation, moments->deviation, RPF_FEATURE_CHUNKS);
  trace_vectors(trace, trace->at.tolerance, moments->tolerance, RPF_FEATURE_CHUNKS);
}

// Of all variables, from vectors in the order of places.
static void trace_variables(const Trace* trace, uint at, const float16* values) {
  float by_place[RPF_CHUNKS * RPF_LANES];
  for (int c = 0; c < RPF_CHUNKS; ++c) vstore16(values[c], c, by_place);
  for (uint v = 0; v < RPF_VARIABLES; ++v) trace->values[at + v] = by_place[place_of(v)];
}

static void trace_neighborhood(const rpf_pass* pass, const OwnMoments* moments, uint own, uint neighbors,
                               const Slot* slot, const Normalization* n, const Trace* trace) {
  if (!trace->values) return;
  trace_moments(trace, moments);
  trace_variables(trace, trace->at.shift, n->shift);
  trace_variables(trace, trace->at.mean, n->mean);
  trace_variables(trace, trace->at.inverse_deviation, n->inverse_deviation);
  for (uint j = 0; j < neighbors; ++j) {
    float16 values[RPF_CHUNKS];
    for (int c = 0; c < RPF_CHUNKS; ++c) values[c] = normalized(pass, slot, j, c, n);
    trace_variables(trace, trace->at.weights + own * neighbors + j * RPF_VARIABLES, values);
  }
}

// What section 5 ends with. One element more than there are features, for none is no size of an array.
typedef struct {
  rpf_color_weights color;
  float feature_fraction_random[RPF_FEATURES + 1], fraction_feature[RPF_FEATURES + 1], beta[RPF_FEATURES + 1];
} Weights;

static void weigh(const Frame* frame, const rpf_pass* pass, uint neighbors, const Slot* slot, const Normalization* n,
                  const Trace* trace, Weights* out, __global float* explained) {
  float information[RPF_PAIRS];
  measure_dependencies(frame, pass, neighbors, slot, n, trace, information);
  const rpf_feature_weights feature = {out->feature_fraction_random, out->fraction_feature, out->beta};
  rpf_weigh_dependencies(information, RPF_RANDOM, RPF_FEATURES, pass->alpha_factor, pass->growth, &out->color, feature);
  for (uint i = 0; RPF_EXPLAIN && i < RPF_PAIRS; ++i) explained[i] = information[i];
  if (!trace->values) return;
  trace_floats(trace, trace->at.information, information, RPF_PAIRS);
  trace_floats(trace, trace->at.color_weights, out->color.color_fraction_random, 3);
  trace->values[trace->at.color_weights + 3] = out->color.fraction_random;
  trace_floats(trace, trace->at.color_weights + 4, out->color.alpha, 3);
  trace_floats(trace, trace->at.feature_fraction_random, out->feature_fraction_random, RPF_FEATURES);
  trace_floats(trace, trace->at.fraction_feature, out->fraction_feature, RPF_FEATURES);
  trace_floats(trace, trace->at.beta, out->beta, RPF_FEATURES);
}

// Sections 3 and 4: the pixel's neighborhood, in the slot. Returns N.
static uint fill_neighborhood(const Frame* frame, const rpf_pass* pass, uint pixel, const Slot* slot, Normalization* n,
                              const Trace* trace, uint* drawn) {
  const uint first = first_sample_of(frame, pass, pixel), own = samples_of(frame, pass, pixel);
  OwnMoments moments;
  own_moments(frame, pass, first, own, &moments);
  const uint neighbors = gather(frame, pass, pixel, first, own, &moments, slot, drawn);
  if (RPF_PHASES < 3) return neighbors;
  settle_shift(pass, neighbors, slot, &moments);
  for (int c = 0; c < RPF_CHUNKS; ++c) n->shift[c] = moments.shift[c];
  measure_moments(pass, neighbors, slot, n);
  trace_neighborhood(pass, &moments, own, neighbors, slot, n, trace);
  return neighbors;
}

// Sections 6 and 7 for the pixel whose neighborhood is in the slot.
static void average_samples(const rpf_pass* pass, uint own, uint neighbors, const Slot* slot, const Normalization* n,
                            const Weights* weights, const Trace* trace, __global float* out,
                            __global float* explained) {
  Means means;
  means.own = own;
  means.neighbors = neighbors;
  means.normalization = n;
  choose_coordinates(pass, &weights->color, weights->beta, &means);
  filter_samples(pass, slot, &means, trace, out);
  if (RPF_EXPLAIN) explained[RPF_PAIRS] = effective_samples(pass, slot, &means);
  for (uint i = 0; trace->values && i < own * RPF_CARRIED; ++i) trace->values[trace->at.filtered + i] = out[i];
  if (pass->outlier_step) replace_outliers(out, own);
}

// What a launch writes: the band's.
typedef struct {
  __global float* colors;                     // [sample][RPF_CARRIED]
  __global rpf_pixel_statistics* statistics;  // [pixel]
  __global float* explained;  // of the tile: [pixel][RPF_PAIRS + 1] mutual information, effective samples
} Output;

// Where a pixel of the tile is explained.
static __global float* explained_at(const rpf_pass* pass, uint pixel, const Output* output) {
  const int2 at = position_of(pass, pixel);
  const int x = at.x, y = at.y;
  return output->explained + (size_t)((y - pass->tile_y) * pass->tile_width + x - pass->tile_x) * (RPF_PAIRS + 1);
}

// Sections 3 to 7 for a pixel.
__attribute__((noinline)) static void filter_pixel(const Frame* frame, const rpf_pass* pass, uint pixel,
                                                   const Slot* slot, Trace* trace, const Output* output) {
  const uint own = samples_of(frame, pass, pixel), first = first_sample_of(frame, pass, pixel);
  rpf_pixel_statistics statistics = {0, 0, 0.0f, 0.0f, 0.0f};
  __global float* explained = RPF_EXPLAIN ? explained_at(pass, pixel, output) : 0;
  if (own > 0) {
    Normalization n;
    Weights weights;
    statistics.neighbors = fill_neighborhood(frame, pass, pixel, slot, &n, trace, &statistics.drawn);
    if (RPF_PHASES > 3) weigh(frame, pass, statistics.neighbors, slot, &n, trace, &weights, explained);
    statistics.fraction_random = weights.color.fraction_random;
    statistics.alpha = rpf_mean(weights.color.alpha, 3);
    statistics.beta = rpf_mean(weights.beta, RPF_FEATURES);
    if (RPF_PHASES > 4)
      average_samples(pass, own, statistics.neighbors, slot, &n, &weights, trace,
                      output->colors + (size_t)(first - pass->first_sample) * RPF_CARRIED, explained);
  }
  output->statistics[pixel - pass->first_pixel] = statistics;
}

#ifdef RPF_AVX512
#pragma clang attribute pop
#endif

// Lays the records and c' of a band out as filter_tile reads them: [RPF_CHUNKS][sample], in the order of place_of().
__kernel void lay_out_records(__global const float* records, __global const float* colors, __global float16* chunks,
                              uint samples) {
  for (uint s = (uint)get_global_id(0); s < samples; s += (uint)get_global_size(0))
    for (uint c = 0; c < RPF_CHUNKS; ++c) {
      float values[RPF_LANES];
      for (uint l = 0; l < RPF_LANES; ++l) {
        const uint place = RPF_LANES * c + l;
        values[l] = 0.0f;
        if (place < RPF_VARIABLES)
          values[l] = records[(size_t)s * RPF_VARIABLES + variable_at(place)];
        else if (place < RPF_VARIABLES + RPF_CARRIED)
          values[l] = colors[(size_t)s * RPF_CARRIED + place - RPF_VARIABLES];
      }
      chunks[(size_t)c * samples + s] = vload16(0, values);
    }
}

// Filters the pixels of a tile. `next_colors` [sample][RPF_CARRIED] and `statistics` [pixel] cover the band. Where
// `trace_values` is not null the tile is one pixel.
__kernel void filter_tile(__global const uint* first_sample, __global const float16* chunks,
                          __global const char* offsets, __global const uint* draws, __global const int* entropy,
                          __global const float* rejection_factor, __global const float* minimum_tolerance,
                          __global uint* candidates, __global uint* neighbors, __global float16* records,
                          __global ulong8* planes, __global float16* columns, __global float16* sums,
                          __global float* next_colors, __global rpf_pixel_statistics* statistics,
                          __global float* explained, __global float* trace_values, __global uint* trace_histograms,
                          const rpf_pass pass) {
  const Frame frame = {first_sample, chunks, offsets, draws, entropy, rejection_factor, minimum_tolerance};
  Trace trace;
  trace.values = trace_values;
  trace.histograms = trace_histograms;
  const size_t item = get_global_id(0);
  const Slot slot = {candidates + item * RPF_DRAWN_AT_ONCE,
                     neighbors + item * pass.capacity,
                     records + item * RPF_CHUNKS * pass.capacity,
                     planes + item * RPF_VARIABLES * rpf_plane_words(pass.capacity) * RPF_BIN_VECTORS,
                     columns + item * RPF_COLUMNS * RPF_STRETCH,
                     sums + item * (pass.most_samples * (1 + RPF_CARRIED) + 1)};
  const Output output = {next_colors, statistics, explained};
  trace.at = rpf_lay_out_trace(RPF_RANDOM, RPF_FEATURES, RPF_CARRIED,
                               samples_of(&frame, &pass, (uint)(pass.tile_y * pass.width + pass.tile_x)));
  const uint across = (uint)pass.tile_width, pixels = across * (uint)pass.tile_height;
  for (uint i = (uint)item; i < pixels; i += (uint)get_global_size(0)) {
    const uint row = i / across, x = (uint)pass.tile_x + i - row * across, y = (uint)pass.tile_y + row;
    filter_pixel(&frame, &pass, y * (uint)pass.width + x, &slot, &trace, &output);
  }
}
