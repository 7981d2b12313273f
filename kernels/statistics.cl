// Sections 4 and 5: normalization, histograms and mutual information. A vector holds RPF_LANES neighbors of one variable.
//
// Histograms are counted in bit planes: for every variable and bin one bit a neighbor, so that a cell of a joint
// histogram is popcount(plane of x & plane of y). Bit k of lane l of group g stands for neighbor (32 g + k) 16 + l.
// Where there is only one group (N <= 512) and it is not full, its lanes are folded together until the words are.

// The bins of a variable that any neighbor is in, and how many are in each. What no neighbor is in costs nothing.
typedef struct {
  uint kinds;
  uchar bin[RPF_BINS];
  uint count[RPF_BINS];
} OccupiedBins;

// The tree of rpf_lanes_total.
static float lanes_total(float16 sum) {
  const float8 a = sum.lo + sum.hi;
  const float4 b = a.lo + a.hi;
  const float2 c = b.lo + b.hi;
  return c.x + c.y;
}

static float largest_lane(float16 value) {
  const float8 a = value.lo > value.hi ? value.lo : value.hi;
  const float4 b = a.lo > a.hi ? a.lo : a.hi;
  const float2 c = b.lo > b.hi ? b.lo : b.hi;
  return c.x > c.y ? c.x : c.y;
}

static int count_lanes(int16 value) {
  const int8 a = value.lo + value.hi;
  const int4 b = a.lo + a.hi;
  return b.x + b.y + b.z + b.w;
}

// Sums of a column. Where the frame has no missing values (RPF_MISSING 0) only the last block can hold any: behind the last
// neighbor.
typedef struct {
  float16 sum, largest;
  int16 missing;
} ColumnSums;

static void add_values(float16 value, float shift, int may_miss, ColumnSums* sums) {
  const float16 magnitude = fabs(value + shift);
  sums->largest = magnitude > sums->largest ? magnitude : sums->largest;
  sums->sum += may_miss ? rpf_or_zero(value) : value;
  if (may_miss) sums->missing += rpf_is_missing(value) ? 1 : 0;
}

static float16 squared(float16 value, float mean, int may_miss) {
  const float16 off = value - mean;
  return may_miss ? rpf_or_zero(off * off) : off * off;
}

// Section 4 for one variable, in place. Returns mean (relative to the shift) and inverse deviation.
static float2 normalize_column(__global float16* column, uint neighbors, float shift) {
  const uint full = neighbors / RPF_LANES, blocks = rpf_blocks(neighbors);
  ColumnSums sums = {0.0f, 0.0f, 0};
  for (uint b = 0; b < full; ++b) add_values(column[b], shift, RPF_MISSING, &sums);
  if (full < blocks) add_values(column[full], shift, 1, &sums);
  const int count = (int)(blocks * RPF_LANES) - count_lanes(sums.missing);
  float2 moments = 0.0f;
  if (count > 0) {
    moments.x = lanes_total(sums.sum) / (float)count;
    float16 squares = 0.0f;
    for (uint b = 0; b < full; ++b) squares += squared(column[b], moments.x, RPF_MISSING);
    if (full < blocks) squares += squared(column[full], moments.x, 1);
    moments.y = rpf_inverse_deviation(lanes_total(squares) / (float)count, largest_lane(sums.largest));
  }
  for (uint b = 0; b < blocks; ++b) column[b] = rpf_normalize(column[b], moments.x, moments.y);
  return moments;
}

// Stores one group of a plane; one that is not full is folded to `words` words.
static void store_plane(__global uint* plane, uint16 bits, uint words, uint blocks) {
  if (words >= 16) {
    vstore16(bits, 0, plane);
    return;
  }
  const uint8 halves = bits.lo | bits.hi << blocks;
  if (words == 8) {
    vstore8(halves, 0, plane);
    return;
  }
  const uint4 quarters = halves.lo | halves.hi << 2 * blocks;
  if (words == 4)
    vstore4(quarters, 0, plane);
  else
    vstore2(quarters.lo | quarters.hi << 4 * blocks, 0, plane);
}

// Bits of a bin's number.
#define RPF_BIN_BITS (RPF_BINS > 15 ? 5 : RPF_BINS > 7 ? 4 : RPF_BINS > 3 ? 3 : 2)

// The plane of one bin from the planes of the bits of its number. `bin` is a constant once the loop is unrolled.
static uint16 plane_of(const uint16* number, int bin, uint16 is_neighbor) {
  uint16 plane = is_neighbor;
#pragma unroll
  for (int i = 0; i < RPF_BIN_BITS; ++i) plane &= (bin >> i & 1) != 0 ? number[i] : ~number[i];
  return plane;
}

// The bit planes of one normalized column.
static void fill_planes(__global const float16* column, uint neighbors, uint words, __global uint* planes) {
  const uint blocks = rpf_blocks(neighbors);
  for (uint group = 0; group * 32 < blocks; ++group) {
    uint16 number[RPF_BIN_BITS];
#pragma unroll
    for (int i = 0; i < RPF_BIN_BITS; ++i) number[i] = 0;
    const uint end = min(blocks - group * 32, 32u);
    for (uint k = 0; k < end; ++k) {
      const uint16 bin = as_uint16(rpf_bin(column[group * 32 + k], RPF_HALF_BINS));
#pragma unroll
      for (int i = 0; i < RPF_BIN_BITS; ++i) number[i] = (bin & 1u << i) != 0 ? number[i] | 1u << k : number[i];
    }
    // Full blocks have all bits; in the last block only the lanes of neighbors count.
    const uint full = min(neighbors / RPF_LANES - group * 32, 32u);
    const uint full_bits = full == 32 ? 0xFFFFFFFFu : (1u << full) - 1;
    const int16 in_last = RPF_LANE_NUMBERS < (int)(neighbors % RPF_LANES);
    const uint16 is_neighbor = full_bits | (as_uint16(in_last) & (full < end ? 1u << full : 0));
#pragma unroll
    for (int bin = 0; bin < RPF_BINS; ++bin)
      store_plane(planes + bin * words + group * RPF_LANES, plane_of(number, bin, is_neighbor), words, blocks);
  }
}

static uint count_bits(__global const ulong* plane, uint words) {
  ulong count = 0;
  for (uint w = 0; w < words / 2; ++w) count += popcount(plane[w]);
  return (uint)count;
}

// Of two planes with a third one: what the loop costs is shared.
static uint2 count_common_bits(__global const ulong* a, __global const ulong* b0, __global const ulong* b1, uint words) {
  ulong count0 = 0, count1 = 0;
  for (uint w = 0; w < words / 2; ++w) {
    const ulong bits = a[w];
    count0 += popcount(bits & b0[w]);
    count1 += popcount(bits & b1[w]);
  }
  return (uint2)((uint)count0, (uint)count1);
}

static void find_occupied_bins(__global const uint* planes, uint words, OccupiedBins* out) {
  out->kinds = 0;
  for (int bin = 0; bin < RPF_BINS; ++bin) {
    const uint count = count_bits((__global const ulong*)(planes + bin * words), words);
    out->bin[out->kinds] = (uchar)bin;
    out->count[out->kinds] = count;
    out->kinds += count > 0;
    if (out->kinds == RPF_BINS) break;
  }
}

static uint entropy_of(__global const int* entropy, const OccupiedBins* x) {
  uint units = 0;
  for (uint a = 0; a < x->kinds; ++a) units += (uint)entropy[x->count[a]];
  return units;
}

static void trace_cell(const Trace* trace, uint pair, const OccupiedBins* x, uint a, const OccupiedBins* y, uint b,
                       uint count) {
  if (trace->values) trace->histograms[(pair * RPF_BINS + x->bin[a]) * RPF_BINS + y->bin[b]] = count;
}

// Sum of S h log2 h over the joint histogram of x and y, modulo 2^32. The last row and column follow from the margins.
static uint joint_entropy(__global const int* entropy, __global const uint* planes_x, const OccupiedBins* x,
                          __global const uint* planes_y, const OccupiedBins* y, uint words, const Trace* trace,
                          uint pair) {
  const uint last_x = x->kinds - 1, last_y = y->kinds - 1;
  uint units = 0, left[RPF_BINS];
  for (uint b = 0; b <= last_y; ++b) left[b] = y->count[b];
  for (uint a = 0; a < last_x; ++a) {
    __global const ulong* plane = (__global const ulong*)(planes_x + x->bin[a] * words);
    uint rest = x->count[a];
    for (uint b = 0; b < last_y; b += 2) {
      const uint next = b + 1 < last_y ? b + 1 : b;  // the same again where the number is odd: counts once
      const uint2 count = count_common_bits(plane, (__global const ulong*)(planes_y + y->bin[b] * words),
                                            (__global const ulong*)(planes_y + y->bin[next] * words), words);
      units += (uint)entropy[count.x];
      rest -= count.x;
      left[b] -= count.x;
      trace_cell(trace, pair, x, a, y, b, count.x);
      if (next == b) break;
      units += (uint)entropy[count.y];
      rest -= count.y;
      left[next] -= count.y;
      trace_cell(trace, pair, x, a, y, next, count.y);
    }
    units += (uint)entropy[rest];
    left[last_y] -= rest;
    trace_cell(trace, pair, x, a, y, last_y, rest);
  }
  for (uint b = 0; b <= last_y; ++b) {
    units += (uint)entropy[left[b]];
    trace_cell(trace, pair, x, last_x, y, b, left[b]);
  }
  return units;
}

// Section 5, first half: information[pair], every color with every variable but the colors, then every feature with
// position and random parameters.
static void measure_dependencies(const Frame* frame, const rpf_pass* pass, uint neighbors, const Slot* slot,
                                 const Trace* trace, float* information) {
  const uint words = rpf_plane_words(neighbors), variable_words = RPF_BINS * words;
  OccupiedBins occupied[RPF_VARIABLES];
  uint margin[RPF_VARIABLES];
  for (uint v = 0; v < RPF_VARIABLES; ++v) {
    __global uint* planes = slot->planes + v * variable_words;
    fill_planes(slot->columns + v * slot->blocks, neighbors, words, planes);
    find_occupied_bins(planes, words, &occupied[v]);
    margin[v] = entropy_of(frame->entropy, &occupied[v]);
  }
  const uint all = (uint)frame->entropy[neighbors];
  uint pair = 0;
  for (uint x = 0; x < RPF_VARIABLES; x = x == 2 ? RPF_FIRST_FEATURE : x + 1) {
    const uint end = x < RPF_POSITION ? RPF_VARIABLES : RPF_FIRST_FEATURE;
    for (uint y = RPF_POSITION; y < end; ++y, ++pair) {
      const uint joint =
          joint_entropy(frame->entropy, slot->planes + x * variable_words, &occupied[x],
                        slot->planes + y * variable_words, &occupied[y], words, trace, pair);
      information[pair] =
          rpf_mutual_information((int)(joint - margin[x] - margin[y] + all), pass->entropy_slack,
                                 pass->nats_per_unit, pass->information_bias, (float)neighbors);
    }
  }
}
