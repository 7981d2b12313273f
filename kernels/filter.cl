// The whole filter of a pixel (algorithm 1, sections 3 to 7), and the kernel that runs it over a tile.
//
// One work-item filters one pixel after the other, with a scratch slot of its own and no barriers. The host starts as
// many as the device can run at once (src/opencl/opencl_backend.cpp).
#include "frame.cl"
#include "neighborhood.cl"
#include "statistics.cl"
#include "weighting.cl"

// How many phases of a pixel run, of five. Only the benchmarks compile less than all, to know what each takes.
#ifndef RPF_PHASES
#define RPF_PHASES 5
#endif

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

// Section 4 for all variables.
static void normalize_columns(const OwnMoments* own, uint neighbors, const Slot* slot, const Trace* trace) {
  float shift[RPF_CHUNKS * RPF_LANES];
  for (int c = 0; c < RPF_CHUNKS; ++c) vstore16(own->shift[c], c, shift);
  for (uint v = 0; v < RPF_VARIABLES; ++v) {
    const float2 moments = normalize_column(slot->columns + v * slot->blocks, neighbors, shift[place_of(v)]);
    if (!trace->values) continue;
    trace->values[trace->at.shift + v] = shift[place_of(v)];
    trace->values[trace->at.mean + v] = moments.x;
    trace->values[trace->at.inverse_deviation + v] = moments.y;
  }
}

// What section 5 ends with. One element more than there are features, for none is no size of an array.
typedef struct {
  rpf_color_weights color;
  float feature_fraction_random[RPF_FEATURES + 1], fraction_feature[RPF_FEATURES + 1], beta[RPF_FEATURES + 1];
} Weights;

static void weigh(const Frame* frame, const rpf_pass* pass, uint neighbors, const Slot* slot, const Trace* trace,
                  Weights* out) {
  float information[RPF_PAIRS];
  measure_dependencies(frame, pass, neighbors, slot, trace, information);
  const rpf_feature_weights feature = {out->feature_fraction_random, out->fraction_feature, out->beta};
  rpf_weigh_dependencies(information, RPF_RANDOM, RPF_FEATURES, pass->alpha_factor, pass->growth, &out->color, feature);
  if (!trace->values) return;
  trace_floats(trace, trace->at.information, information, RPF_PAIRS);
  trace_floats(trace, trace->at.color_weights, out->color.color_fraction_random, 3);
  trace->values[trace->at.color_weights + 3] = out->color.fraction_random;
  trace_floats(trace, trace->at.color_weights + 4, out->color.alpha, 3);
  trace_floats(trace, trace->at.feature_fraction_random, out->feature_fraction_random, RPF_FEATURES);
  trace_floats(trace, trace->at.fraction_feature, out->fraction_feature, RPF_FEATURES);
  trace_floats(trace, trace->at.beta, out->beta, RPF_FEATURES);
}

RPF_CPU_FEATURES
static rpf_pixel_statistics filter_pixel(const Frame* frame, const rpf_pass* pass, uint pixel, const Slot* slot,
                                         const Trace* trace, __global float* out) {
  const uint first = first_sample_of(frame, pass, pixel), own = samples_of(frame, pass, pixel);
  rpf_pixel_statistics statistics = {0, 0, 0.0f, 0.0f, 0.0f};
  if (own == 0) return statistics;

  OwnMoments moments;
  own_moments(frame, pass, first, own, &moments);
  statistics.drawn = draw_candidates(frame, pass, pixel, own, slot);
  if (RPF_PHASES == 1) return statistics;
  const uint neighbors = gather(frame, pass, first, own, &moments, statistics.drawn, slot);
  statistics.neighbors = neighbors;
  if (RPF_PHASES == 2) return statistics;
  fill_columns(frame, pass, neighbors, &moments, slot);
  normalize_columns(&moments, neighbors, slot, trace);
  if (RPF_PHASES == 3) return statistics;

  Weights weights;
  weigh(frame, pass, neighbors, slot, trace, &weights);
  statistics.fraction_random = weights.color.fraction_random;
  statistics.alpha = rpf_mean(weights.color.alpha, 3);
  statistics.beta = rpf_mean(weights.beta, RPF_FEATURES);
  if (RPF_PHASES == 4) return statistics;

  Coordinates coordinates;
  choose_coordinates(pass, own, &weights.color, weights.beta, &coordinates);
  filter_samples(own, neighbors, slot, &coordinates, trace, out);
  if (trace->values) {
    trace_moments(trace, &moments);
    for (uint i = 0; i < own * RPF_CARRIED; ++i) trace->values[trace->at.filtered + i] = out[i];
  }
  if (pass->outlier_step) replace_outliers(out, own);
  return statistics;
}

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
                          __global const char* offsets, __global const uint* draws,
                          __global const int* entropy, __global const float* rejection_factor,
                          __global const float* minimum_tolerance, __global uint* candidates, __global uint* neighbors,
                          __global float16* columns, __global uint* planes, __global float16* neighbor_colors,
                          __global float* next_colors, __global rpf_pixel_statistics* statistics,
                          __global float* trace_values, __global uint* trace_histograms, const rpf_pass pass) {
  const Frame frame = {first_sample, chunks, offsets, draws, entropy, rejection_factor, minimum_tolerance};
  Trace trace;
  trace.values = trace_values;
  trace.histograms = trace_histograms;
  const size_t item = get_global_id(0);
  const uint blocks = pass.capacity / RPF_LANES, words = (blocks + 31) / 32 * RPF_LANES;
  const Slot slot = {candidates + item * pass.capacity,
                     neighbors + item * pass.capacity,
                     columns + item * RPF_VARIABLES * blocks,
                     planes + item * RPF_VARIABLES * RPF_BINS * words,
                     neighbor_colors + item * RPF_CARRIED * blocks,
                     blocks};
  const uint pixels = (uint)(pass.tile_width * pass.tile_height);
  for (uint i = (uint)item; i < pixels; i += (uint)get_global_size(0)) {
    const uint row = i / (uint)pass.tile_width, column = i - row * (uint)pass.tile_width;
    const uint pixel = ((uint)pass.tile_y + row) * (uint)pass.width + (uint)pass.tile_x + column;
    const uint first = first_sample_of(&frame, &pass, pixel);
    trace.at = rpf_lay_out_trace(RPF_RANDOM, RPF_FEATURES, RPF_CARRIED, samples_of(&frame, &pass, pixel));
    statistics[pixel - pass.first_pixel] =
        filter_pixel(&frame, &pass, pixel, &slot, &trace,
                     next_colors + (size_t)(first - pass.first_sample) * RPF_CARRIED);
  }
}
