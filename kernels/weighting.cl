// Sections 6 and 7: the weighted means of a pixel's samples, and the outlier step after them.
//
// What a pixel is filtered with (Means: own, neighbors, count; fill_columns; load_own) comes from coordinates.cl or
// box.cl.

// A pixel of very many samples is long: it takes several launches, so that none takes seconds. Each finds the same
// neighborhood, and filters a part of the own samples; what is filtered, and the sums in the slot, stay for the next.
// Then one more replaces outliers. RPF_LONG: 1 where the frame has such pixels.
#ifndef RPF_LONG
#define RPF_LONG 0
#endif

static uint first_own(const rpf_pass* pass, const Means* means) {
  return RPF_LONG ? min(pass->first_own, means->own) : 0;
}

static uint end_own(const rpf_pass* pass, const Means* means) {
  return RPF_LONG ? min(pass->end_own, means->own) : means->own;
}

// The own samples that take the stretch from block `first` on.
static uint group_begin(const Means* means, uint first) { return rpf_group_begin(means->own, first * RPF_LANES); }
static uint group_end(const Means* means, uint first) { return rpf_group_end(means->own, first * RPF_LANES); }

// The tree of rpf_lanes_total.
static float lanes_total(float16 sum) {
  const float8 a = sum.lo + sum.hi;
  const float4 b = a.lo + a.hi;
  const float2 c = b.lo + b.hi;
  return c.x + c.y;
}

static float smallest_lane(float16 value) {
  const float8 a = value.lo < value.hi ? value.lo : value.hi;
  const float4 b = a.lo < a.hi ? a.lo : a.hi;
  const float2 c = b.lo < b.hi ? b.lo : b.hi;
  return c.x < c.y ? c.x : c.y;
}

static float largest_lane(float16 value) { return -smallest_lane(-value); }

// Weights of the RPF_LANES neighbors in a block of the columns for each own sample of the batch.
static void block_weights(const Slot* slot, uint coordinates, float (*own)[RPF_COORDINATES], uint block,
                          int neighbors_left, float16* weight) {
  float16 distance[RPF_BATCH];
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) distance[i] = 0.0f;
  for (uint a = 0; a < coordinates; ++a) {
    const float16 value = slot->columns[a * RPF_STRETCH + block];
#pragma unroll
    for (int i = 0; i < RPF_BATCH; ++i) {
      const float16 difference = own[i][a] - value;
      distance[i] += difference * difference;
    }
  }
  const int16 is_neighbor = RPF_LANE_NUMBERS < neighbors_left;
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

// The weighted sums of a batch over a stretch.
typedef struct {
  float16 weight[RPF_BATCH], color[RPF_BATCH][RPF_CARRIED];
} Sums;

// The stretch from block `first` on, whose columns are filled, for a batch of the own samples from `begin` to `end`.
static void sum_stretch(const Slot* slot, const Means* means, float (*own)[RPF_COORDINATES], uint begin, uint end,
                        uint first, uint last, const Trace* trace, Sums* sums) {
#pragma unroll
  for (int i = 0; i < RPF_BATCH; ++i) {
    sums->weight[i] = 0.0f;
    for (int c = 0; c < RPF_CARRIED; ++c) sums->color[i][c] = 0.0f;
  }
  for (uint block = first; block < last; ++block) {
    float16 weight[RPF_BATCH];
    block_weights(slot, means->count, own, block - first, (int)(means->neighbors - block * RPF_LANES), weight);
#pragma unroll
    for (int i = 0; i < RPF_BATCH; ++i) {
      sums->weight[i] += weight[i];
      for (int c = 0; c < RPF_CARRIED; ++c)
        sums->color[i][c] += weight[i] * slot->columns[(RPF_FIRST_COLOR + c) * RPF_STRETCH + block - first];
      if (begin + i < end) trace_weights(trace, begin + i, means->neighbors, block, weight[i]);
    }
  }
}

// Adds a stretch to the sums of the own samples that take it.
static void add_stretch(const rpf_pass* pass, const Slot* slot, const Means* means, uint first, uint last,
                        const Trace* trace) {
  const uint end = min(end_own(pass, means), group_end(means, first));
  for (uint begin = max(first_own(pass, means), group_begin(means, first)); begin < end; begin += RPF_BATCH) {
    float own[RPF_BATCH][RPF_COORDINATES];
    Sums stretch;
    load_own(pass, slot, means, begin, own);
    sum_stretch(slot, means, own, begin, end, first, last, trace, &stretch);
#pragma unroll
    for (uint i = 0; i < RPF_BATCH; ++i) {
      if (begin + i >= end) continue;
      __global float16* sums = slot->sums + (begin + i) * (1 + RPF_CARRIED);
      sums[0] += stretch.weight[i];
      for (int c = 0; c < RPF_CARRIED; ++c) sums[1 + c] += stretch.color[i][c];
    }
  }
}

// The smallest and largest of every carried channel.
typedef struct {
  float16 smallest[RPF_CARRIED], largest[RPF_CARRIED];
} Ranges;

static void widen(const Slot* slot, uint blocks, Ranges* ranges) {
  for (int c = 0; c < RPF_CARRIED; ++c)
    for (uint b = 0; b < blocks; ++b) {
      const float16 color = slot->columns[(RPF_FIRST_COLOR + c) * RPF_STRETCH + b];
      ranges->smallest[c] = color < ranges->smallest[c] ? color : ranges->smallest[c];
      ranges->largest[c] = color > ranges->largest[c] ? color : ranges->largest[c];
    }
}

// Section 6: out[own][RPF_CARRIED].
static void filter_samples(const rpf_pass* pass, const Slot* slot, const Means* means, const Trace* trace,
                           __global float* out) {
  const uint blocks = rpf_blocks(means->neighbors);
  Ranges ranges;
  for (int c = 0; c < RPF_CARRIED; ++c) {
    ranges.smallest[c] = INFINITY;
    ranges.largest[c] = -INFINITY;
  }
  const uint begin = first_own(pass, means), end = end_own(pass, means);
  for (uint i = begin * (1 + RPF_CARRIED); i < end * (1 + RPF_CARRIED); ++i) slot->sums[i] = 0.0f;
  for (uint first = 0; first < blocks; first += RPF_STRETCH) {
    const uint last = min(first + RPF_STRETCH, blocks);
    fill_columns(pass, slot, means, first, last);
    widen(slot, last - first, &ranges);
    add_stretch(pass, slot, means, first, last, trace);
  }
  for (uint i = begin; i < end; ++i) {
    __global const float16* sums = slot->sums + i * (1 + RPF_CARRIED);
    for (int c = 0; c < RPF_CARRIED; ++c)
      out[i * RPF_CARRIED + c] = rpf_filtered(lanes_total(sums[1 + c]), lanes_total(sums[0]),
                                              smallest_lane(ranges.smallest[c]), largest_lane(ranges.largest[c]));
  }
}

// After filter_samples(): rpf_effective_samples() of the pixel. All own samples are added up before squares are, hence
// a way of its own through the neighborhood. Only `rpf explain` asks for it. Of a long pixel a launch adds some blocks
// of neighbors to the squares so far, which stand behind the sums.
static float effective_samples(const rpf_pass* pass, const Slot* slot, const Means* means) {
  const uint blocks = RPF_LONG ? min(rpf_blocks(means->neighbors), pass->end_block) : rpf_blocks(means->neighbors);
  const uint begin_block = RPF_LONG ? pass->first_block : 0;
  __global float16* kept = slot->sums + pass->most_samples * (1 + RPF_CARRIED);
  float16 squares = begin_block > 0 ? kept[0] : 0.0f;
  for (uint first = begin_block, last; first < blocks; first = last) {
    last = min(first / RPF_STRETCH * RPF_STRETCH + RPF_STRETCH, blocks);  // stretches have groups
    fill_columns(pass, slot, means, first, last);
    for (uint block = first; block < last; ++block) {
      float16 share = 0.0f;
      const uint end = group_end(means, first);
      for (uint begin = group_begin(means, first); begin < end; begin += RPF_BATCH) {
        float own[RPF_BATCH][RPF_COORDINATES];
        float16 weight[RPF_BATCH];
        load_own(pass, slot, means, begin, own);
        block_weights(slot, means->count, own, block - first, (int)(means->neighbors - block * RPF_LANES), weight);
        for (uint i = 0; i < RPF_BATCH && begin + i < end; ++i)
          share += weight[i] * (1.0f / lanes_total(slot->sums[(begin + i) * (1 + RPF_CARRIED)]));
      }
      squares += share * share;
    }
  }
  if (RPF_LONG) kept[0] = squares;
  return rpf_effective_samples(means->own, lanes_total(squares));
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
