// Sections 6 and 7: the weighted means of a pixel's samples, and the outlier step after them.

// Own samples that are filtered together: a neighbor's coordinates are read once for all of them.
#define RPF_BATCH (RPF_SAMPLES > 0 && RPF_SAMPLES < 4 ? RPF_SAMPLES : 4)

#define RPF_COORDINATES (5 + RPF_FEATURES)  // at most: position (section 8), colors, features

// The variables that take part in the distance, and what their values are multiplied with.
typedef struct {
  uint count;
  uint column[RPF_COORDINATES];
  float scale[RPF_COORDINATES];
} Coordinates;

static void add_coordinate(uint variable, float scale, Coordinates* out) {
  if (!(scale > 0.0f)) return;
  out->column[out->count] = variable;
  out->scale[out->count] = scale;
  ++out->count;
}

static void choose_coordinates(const rpf_pass* pass, uint own, const rpf_color_weights* color, const float* beta,
                               Coordinates* out) {
  const float sharpness = rpf_sharpness(color->fraction_random, pass->noise, own);
  out->count = 0;
  for (uint i = 0; i < 3; ++i) add_coordinate(i, rpf_distance_scale(sharpness, color->alpha[i]), out);
  for (uint k = 0; k < RPF_FEATURES; ++k)
    add_coordinate(RPF_FIRST_FEATURE + k, rpf_distance_scale(sharpness, beta[k]), out);
}

// Behind the last neighbor stands the first one's c': it has no weight, and it is inside every range.
static void fill_up_colors(uint neighbors, const Slot* slot) {
  if (neighbors % RPF_LANES == 0) return;
  for (int c = 0; c < RPF_CARRIED; ++c) {
    __global float16* column = slot->colors + c * slot->blocks;
    const int16 is_neighbor = RPF_LANE_NUMBERS < (int)(neighbors % RPF_LANES);
    column[neighbors / RPF_LANES] = is_neighbor ? column[neighbors / RPF_LANES] : column[0].s0;
  }
}

static float smallest_lane(float16 value) { return -largest_lane(-value); }

// The range of one carried channel over the neighbors.
static float2 range_of(__global const float16* column, uint blocks) {
  float16 smallest = column[0], largest = column[0];
  for (uint b = 1; b < blocks; ++b) {
    smallest = column[b] < smallest ? column[b] : smallest;
    largest = column[b] > largest ? column[b] : largest;
  }
  return (float2)(smallest_lane(smallest), largest_lane(largest));
}

// Weights of RPF_LANES neighbors for each own sample of the batch.
static void block_weights(const Slot* slot, const Coordinates* coordinates, float (*own)[RPF_COORDINATES], uint block,
                          uint neighbors, float16* weight) {
  float16 distance[RPF_BATCH];
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) distance[i] = 0.0f;
  for (uint a = 0; a < coordinates->count; ++a) {
    const float16 value = slot->columns[coordinates->column[a] * slot->blocks + block] * coordinates->scale[a];
#pragma unroll
    for (int i = 0; i < RPF_BATCH; ++i) {
      const float16 difference = own[i][a] - value;
      distance[i] += difference * difference;
    }
  }
  const int16 is_neighbor = RPF_LANE_NUMBERS < (int)(neighbors - block * RPF_LANES);
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) weight[i] = is_neighbor ? rpf_weight(distance[i]) : 0.0f;
}

static void trace_weights(const Trace* trace, uint sample, uint neighbors, uint block, float16 weight) {
  if (!trace->values) return;
  float lane[RPF_LANES];
  vstore16(weight, 0, lane);
  __global float* to = trace->values + trace->at.weights + sample * neighbors + block * RPF_LANES;
  for (uint l = 0; l < RPF_LANES && block * RPF_LANES + l < neighbors; ++l) to[l] = lane[l];
}

// The weighted sums of RPF_BATCH own samples.
typedef struct {
  float16 weight[RPF_BATCH], color[RPF_BATCH][RPF_CARRIED];
} Sums;

static void clear_sums(Sums* sums) {
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) {
    sums->weight[i] = 0.0f;
    for (int c = 0; c < RPF_CARRIED; ++c) sums->color[i][c] = 0.0f;
  }
}

// Adds the blocks [first, last), one stretch, to the sums of the own samples from `begin`.
static void add_stretch(const Slot* slot, const Coordinates* coordinates, float (*own_value)[RPF_COORDINATES],
                        uint begin, uint own, uint neighbors, uint first, uint last, const Trace* trace, Sums* sums) {
  Sums stretch;
  float16 weight[RPF_BATCH];
  clear_sums(&stretch);
  for (uint block = first; block < last; ++block) {
    block_weights(slot, coordinates, own_value, block, neighbors, weight);
#pragma unroll
    for (int i = 0; i < RPF_BATCH; ++i) {
      stretch.weight[i] += weight[i];
      for (int c = 0; c < RPF_CARRIED; ++c) stretch.color[i][c] += weight[i] * slot->colors[c * slot->blocks + block];
      if (begin + i < own) trace_weights(trace, begin + i, neighbors, block, weight[i]);
    }
  }
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) {
    sums->weight[i] += stretch.weight[i];
    for (int c = 0; c < RPF_CARRIED; ++c) sums->color[i][c] += stretch.color[i][c];
  }
}

// Filters RPF_BATCH own samples from `begin`: out[own][RPF_CARRIED]. Behind the last own sample it repeats that one.
static void filter_batch(const Slot* slot, const Coordinates* coordinates, uint begin, uint own, uint neighbors,
                         const float2* range, const Trace* trace, __global float* out) {
  const uint blocks = rpf_blocks(neighbors);
  float own_value[RPF_BATCH][RPF_COORDINATES];
  Sums sums;
  for (uint i = 0; i < RPF_BATCH; ++i) {
    const uint sample = min(begin + i, own - 1);
    for (uint a = 0; a < coordinates->count; ++a) {
      __global const float* column = (__global const float*)(slot->columns + coordinates->column[a] * slot->blocks);
      own_value[i][a] = column[sample] * coordinates->scale[a];
    }
  }
  clear_sums(&sums);
  for (uint block = 0; block < blocks; block += RPF_STRETCH)
    add_stretch(slot, coordinates, own_value, begin, own, neighbors, block, min(block + RPF_STRETCH, blocks), trace,
                &sums);
  for (uint i = 0; i < RPF_BATCH && begin + i < own; ++i)
    for (int c = 0; c < RPF_CARRIED; ++c)
      out[(begin + i) * RPF_CARRIED + c] =
          rpf_filtered(lanes_total(sums.color[i][c]), lanes_total(sums.weight[i]), range[c].x, range[c].y);
}

static void filter_samples(uint own, uint neighbors, const Slot* slot, const Coordinates* coordinates,
                           const Trace* trace, __global float* out) {
  fill_up_colors(neighbors, slot);
  float2 range[RPF_CARRIED];
  for (int c = 0; c < RPF_CARRIED; ++c)
    range[c] = range_of(slot->colors + c * slot->blocks, rpf_blocks(neighbors));
  for (uint begin = 0; begin < own; begin += RPF_BATCH)
    filter_batch(slot, coordinates, begin, own, neighbors, range, trace, out);
}

// Mean (relative to the shift) and standard deviation of one channel of a pixel's filtered samples.
static float2 channel_moments(__global const float* filtered, uint samples, uint channel, float shift) {
  rpf_lanes sum;
  rpf_lanes_clear(&sum);
  for (uint i = 0; i < samples; ++i) rpf_lanes_add(&sum, i, filtered[i * RPF_CARRIED + channel] - shift);
  const float mean = rpf_lanes_total(&sum) / (float)samples;
  rpf_lanes_clear(&sum);
  for (uint i = 0; i < samples; ++i) {
    const float off = (filtered[i * RPF_CARRIED + channel] - shift) - mean;
    rpf_lanes_add(&sum, i, off * off);
  }
  return (float2)(mean, sqrt(rpf_lanes_total(&sum) / (float)samples));
}

// Section 7, in place.
static void replace_outliers(__global float* filtered, uint samples) {
  float shift[3];
  float2 before[3];
  for (uint c = 0; c < 3; ++c) {
    shift[c] = filtered[c];
    before[c] = channel_moments(filtered, samples, c, shift[c]);
  }
  for (uint i = 0; i < samples; ++i) {
    __global float* sample = filtered + i * RPF_CARRIED;
    int outlier = 0;
    for (uint c = 0; c < 3; ++c) outlier |= rpf_is_outlier(sample[c] - shift[c], before[c].x, before[c].y);
    for (uint c = 0; outlier && c < 3; ++c) sample[c] = shift[c] + before[c].x;
  }
  for (uint c = 0; c < 3; ++c) {
    const float taken = before[c].x - channel_moments(filtered, samples, c, shift[c]).x;
    for (uint i = 0; i < samples; ++i) filtered[i * RPF_CARRIED + c] += taken;
  }
}
