// Sections 4 and 5: normalization, histograms and mutual information.
//
// A vector holds RPF_LANES variables of one neighbor: what is summed over neighbors is summed for all of them at once.
//
// Histograms are counted in bit planes: for every variable and bin one bit a neighbor, so that a cell of a joint
// histogram is popcount(plane of x & plane of y). Words have 64 neighbors; the words of all bins of a variable stand
// side by side, so that one vector counts a row of a histogram.

// Section 4 of a neighborhood, by place. Places behind the last variable, c' among them, are left as they are: 0 and 1.
typedef struct {
  float16 shift[RPF_CHUNKS], mean[RPF_CHUNKS], inverse_deviation[RPF_CHUNKS];
} Normalization;

// Variables of neighbor j, less the shift.
static float16 shifted(const rpf_pass* pass, const Slot* slot, uint j, int chunk, float16 shift) {
  return slot->records[chunk * pass->capacity + j] - shift;
}

static float16 or_zero(float16 value) { return RPF_MISSING ? rpf_or_zero(value) : value; }

static float16 normalized(const rpf_pass* pass, const Slot* slot, uint j, int chunk, const Normalization* n) {
  const float16 value = shifted(pass, slot, j, chunk, n->shift[chunk]);
  return or_zero(rpf_normalize(value, n->mean[chunk], n->inverse_deviation[chunk]));
}

// Sums over the neighbors, for RPF_LANES variables.
typedef struct {
  rpf_lanes16 values;
  float16 largest;
  int16 missing;
} RecordSums;

static void sum_values(const rpf_pass* pass, uint neighbors, const Slot* slot, int chunk, float16 shift,
                       RecordSums* out) {
  RecordSums sums;
  rpf_lanes_clear(&sums.values);
  sums.largest = 0.0f;
  sums.missing = 0;
  for (uint block = 0; block < neighbors; block += RPF_LANES) {
#pragma unroll
    for (uint l = 0; l < RPF_LANES; ++l) {
      if (block + l >= neighbors) continue;
      const float16 value = shifted(pass, slot, block + l, chunk, shift), magnitude = fabs(value + shift);
      sums.largest = magnitude > sums.largest ? magnitude : sums.largest;
      sums.values.lane[l] += or_zero(value);
      if (RPF_MISSING) sums.missing += rpf_is_missing(value) ? 1 : 0;
    }
  }
  *out = sums;
}

static float16 sum_squares(const rpf_pass* pass, uint neighbors, const Slot* slot, int chunk, float16 shift,
                           float16 mean) {
  rpf_lanes16 sum;
  rpf_lanes_clear(&sum);
  for (uint block = 0; block < neighbors; block += RPF_LANES) {
#pragma unroll
    for (uint l = 0; l < RPF_LANES; ++l) {
      if (block + l >= neighbors) continue;
      const float16 off = shifted(pass, slot, block + l, chunk, shift) - mean;
      sum.lane[l] += or_zero(off * off);
    }
  }
  return rpf_lanes_total(&sum);
}

// Section 4, but for the normalized values themselves: they are computed where they are needed. `shift` is set.
static void measure_moments(const rpf_pass* pass, uint neighbors, const Slot* slot, Normalization* n) {
#pragma unroll
  for (int c = 0; c < RPF_CHUNKS; ++c) {
    const int16 is_variable = RPF_LANE_NUMBERS < RPF_VARIABLES - RPF_LANES * c;
    RecordSums sums;
    sum_values(pass, neighbors, slot, c, n->shift[c], &sums);
    const int16 present = (int)neighbors - sums.missing;
    const float16 count = convert_float16(present);
    const float16 mean = present == 0 ? 0.0f : rpf_lanes_total(&sums.values) / count;
    const float16 squares = sum_squares(pass, neighbors, slot, c, n->shift[c], mean);
    const float16 inverse = present == 0 ? 0.0f : rpf_inverse_deviation(squares / count, sums.largest);
    n->mean[c] = is_variable ? mean : 0.0f;
    n->inverse_deviation[c] = is_variable ? inverse : 1.0f;
  }
}

// The bins of some neighbors go into one word each, a field a neighbor, then bit i of all fields into plane i.
// (rpf_plane_bit says which bit a neighbor has in the end.)
#define RPF_FIELD_BITS (RPF_BINS > 15 ? 8 : 4)  // rpf_bin_field(): shifts are constants where this is
#define RPF_FIELDS (32 / RPF_FIELD_BITS)
#define RPF_BIN_BITS (RPF_BINS > 15 ? 5 : RPF_BINS > 7 ? 4 : RPF_BINS > 3 ? 3 : 2)
#define RPF_EACH_FIELD (RPF_BINS > 15 ? 0x01010101u : 0x11111111u)

// The bins of neighbors begin .. end - 1, RPF_FIELDS at most, for RPF_LANES variables.
static uint16 pack_bins(const rpf_pass* pass, uint begin, uint end, const Slot* slot, int chunk,
                        const Normalization* n) {
  int16 fields = 0;
#pragma unroll
  for (uint i = 0; i < RPF_FIELDS; ++i) {
    if (begin + i >= end) break;
    const float16 value = normalized(pass, slot, begin + i, chunk, n);
    fields += rpf_signed_bin(value, RPF_HALF_BINS) * (1 << (RPF_FIELD_BITS * i));
  }
  return as_uint16(fields) + RPF_EACH_FIELD * RPF_HALF_BINS;
}

// The plane of one bin from the planes of the bits of its number. `bin` is a constant once the loop is unrolled.
static uint16 plane_of(const uint16* number, int bin, uint16 is_neighbor) {
  uint16 plane = is_neighbor;
#pragma unroll
  for (int i = 0; i < RPF_BIN_BITS; ++i) plane &= (bin >> i & 1) != 0 ? number[i] : ~number[i];
  return plane;
}

// Bit planes of RPF_LANES variables, of up to 32 neighbors: [bin], a variable a lane.
__attribute__((always_inline)) static void fill_half_words(const rpf_pass* pass, uint begin, uint end, const Slot* slot,
                                                           int chunk, const Normalization* n, uint16* planes) {
  uint16 number[RPF_BIN_BITS];
  uint is_neighbor = 0;
#pragma unroll
  for (int i = 0; i < RPF_BIN_BITS; ++i) number[i] = 0;
  for (uint k = 0; k < RPF_FIELD_BITS && begin < end; ++k, begin += RPF_FIELDS) {
    const uint16 bins = pack_bins(pass, begin, end, slot, chunk, n);
    const uint fields = min(end - begin, (uint)RPF_FIELDS);
    is_neighbor |= (RPF_EACH_FIELD >> (32 - RPF_FIELD_BITS * fields)) << k;
#pragma unroll
    for (int i = 0; i < RPF_BIN_BITS; ++i) number[i] |= (bins >> i & RPF_EACH_FIELD) << k;
  }
#pragma unroll
  for (int bin = 0; bin < RPF_BINS; ++bin) planes[bin] = plane_of(number, bin, is_neighbor);
}

// Word `word` of the planes of RPF_LANES variables, from both halves of it: [half][bin], a variable a lane.
static void store_words(uint16 (*halves)[RPF_BIN_VECTORS * RPF_BINS_AT_ONCE], int chunk, uint word, uint words,
                        const Slot* slot) {
#pragma unroll
  for (int v = 0; v < RPF_BIN_VECTORS; ++v) {
    float16 rows[RPF_LANES];
#pragma unroll
    for (int bin = 0; bin < RPF_BINS_AT_ONCE; ++bin) {
      rows[2 * bin] = as_float16(halves[0][v * RPF_BINS_AT_ONCE + bin]);
      rows[2 * bin + 1] = as_float16(halves[1][v * RPF_BINS_AT_ONCE + bin]);
    }
    transpose(rows);
#pragma unroll
    for (int l = 0; l < RPF_LANES; ++l) {
      const uint place = (uint)(RPF_LANES * chunk + l);
      if (place < RPF_VARIABLES)
        slot->planes[(variable_at(place) * words + word) * RPF_BIN_VECTORS + v] = as_ulong8(rows[l]);
    }
  }
}

// The bit planes of all variables.
static void fill_planes(const rpf_pass* pass, uint neighbors, uint words, const Slot* slot, const Normalization* n) {
#pragma unroll
  for (int chunk = 0; chunk * RPF_LANES < RPF_VARIABLES; ++chunk)
    for (uint word = 0; word < words; ++word) {
      const uint begin = word * RPF_WORD_BITS, middle = min(begin + RPF_WORD_BITS / 2, neighbors);
      const uint end = min(begin + RPF_WORD_BITS, neighbors);
      uint16 halves[2][RPF_BIN_VECTORS * RPF_BINS_AT_ONCE];
#pragma unroll
      for (int bin = RPF_BINS; bin < RPF_BIN_VECTORS * RPF_BINS_AT_ONCE; ++bin) halves[0][bin] = halves[1][bin] = 0;
      fill_half_words(pass, begin, middle, slot, chunk, n, halves[0]);
      fill_half_words(pass, middle, end, slot, chunk, n, halves[1]);
      store_words(halves, chunk, word, words, slot);
    }
}

// The bins of a variable: how many neighbors are in each, and which ones have any.
typedef struct {
  uint8 count[RPF_BIN_VECTORS];
  uint kinds;
  uchar bin[RPF_BINS];
} Margin;

static void store_row(const uint8* row, uint* count) {
#pragma unroll
  for (int v = 0; v < RPF_BIN_VECTORS; ++v) vstore8(row[v], v, count);
}

// Sum of S h log2 h over a row of a histogram.
static uint entropy_of(__global const int* entropy, const uint8* row) {
  uint units = 0, count[RPF_BIN_VECTORS * RPF_BINS_AT_ONCE];
  store_row(row, count);
#pragma unroll
  for (int bin = 0; bin < RPF_BINS; ++bin) units += (uint)entropy[count[bin]];
  return units;
}

static void count_margin(__global const ulong8* planes, uint words, Margin* out) {
  uint count[RPF_BIN_VECTORS * RPF_BINS_AT_ONCE];
#pragma unroll
  for (int v = 0; v < RPF_BIN_VECTORS; ++v) {
    ulong8 bits = 0;
    for (uint w = 0; w < words; ++w) bits += total_of(bits_of(planes[w * RPF_BIN_VECTORS + v]));
    out->count[v] = convert_uint8(bits);
  }
  store_row(out->count, count);
  out->kinds = 0;
  for (int bin = 0; bin < RPF_BINS; ++bin) {
    out->bin[out->kinds] = (uchar)bin;
    out->kinds += count[bin] > 0;
    if (out->kinds == RPF_BINS) break;
  }
}

// Rows of a joint histogram that are counted together: what the planes of y cost is shared.
#define RPF_ROWS 3

// Rows of the joint histogram of x and y, by the planes of some bins of x.
static void count_rows(__global const ulong8* planes_x, const uchar* bins, __global const ulong8* planes_y, uint words,
                       uint8 (*rows)[RPF_BIN_VECTORS]) {
  __global const ulong* x = (__global const ulong*)planes_x;
  __global const ulong *x0 = x + bins[0], *x1 = x + bins[1], *x2 = x + bins[2];
  const size_t stride = RPF_BIN_VECTORS * RPF_BINS_AT_ONCE;
#pragma unroll
  for (int v = 0; v < RPF_BIN_VECTORS; ++v) {
    ulong8 count0 = 0, count1 = 0, count2 = 0;
    for (size_t first = 0, end; first < words; first = end) {
      end = end_of_words(first, words);
      ulong8 sum0 = 0, sum1 = 0, sum2 = 0;
      for (size_t w = first; w < end; ++w) {
        const ulong8 y = planes_y[w * RPF_BIN_VECTORS + v];
        sum0 += bits_of(y & x0[w * stride]);
        sum1 += bits_of(y & x1[w * stride]);
        sum2 += bits_of(y & x2[w * stride]);
      }
      count0 += total_of(sum0);
      count1 += total_of(sum1);
      count2 += total_of(sum2);
    }
    rows[0][v] = convert_uint8(count0);
    rows[1][v] = convert_uint8(count1);
    rows[2][v] = convert_uint8(count2);
  }
}

static void trace_row(const Trace* trace, uint pair, uint bin, const uint8* row) {
  if (!trace->values) return;
  uint count[RPF_BIN_VECTORS * RPF_BINS_AT_ONCE];
  store_row(row, count);
  for (int b = 0; b < RPF_BINS; ++b) trace->histograms[(pair * RPF_BINS + bin) * RPF_BINS + b] = count[b];
}

// Sum of S h log2 h over the joint histogram of x and y, modulo 2^32. The last row follows from the margin of y.
static uint joint_entropy(__global const int* entropy, __global const ulong8* planes_x, const Margin* x,
                          __global const ulong8* planes_y, const Margin* y, uint words, const Trace* trace, uint pair) {
  const uint last = x->kinds - 1;
  uint units = 0;
  uint8 left[RPF_BIN_VECTORS];
#pragma unroll
  for (int v = 0; v < RPF_BIN_VECTORS; ++v) left[v] = y->count[v];
  for (uint a = 0; a < last; a += RPF_ROWS) {
    uchar bins[RPF_ROWS];
    uint8 rows[RPF_ROWS][RPF_BIN_VECTORS];
#pragma unroll
    for (uint i = 0; i < RPF_ROWS; ++i) bins[i] = x->bin[min(a + i, last)];
    count_rows(planes_x, bins, planes_y, words, rows);
#pragma unroll
    for (uint i = 0; i < RPF_ROWS; ++i) {
      if (a + i >= last) continue;
      units += entropy_of(entropy, rows[i]);
      trace_row(trace, pair, bins[i], rows[i]);
#pragma unroll
      for (int v = 0; v < RPF_BIN_VECTORS; ++v) left[v] -= rows[i][v];
    }
  }
  trace_row(trace, pair, x->bin[last], left);
  return units + entropy_of(entropy, left);
}

// Section 5, first half: information[pair], every color with every variable but the colors, then every feature with
// position and random parameters.
static void measure_dependencies(const Frame* frame, const rpf_pass* pass, uint neighbors, const Slot* slot,
                                 const Normalization* n, const Trace* trace, float* information) {
  const uint words = rpf_plane_words(neighbors), variable_planes = words * RPF_BIN_VECTORS;
  Margin margin[RPF_VARIABLES];
  uint units[RPF_VARIABLES];
  fill_planes(pass, neighbors, words, slot, n);
  for (uint v = 0; v < RPF_VARIABLES; ++v) {
    count_margin(slot->planes + v * variable_planes, words, &margin[v]);
    units[v] = entropy_of(frame->entropy, margin[v].count);
  }
  const uint all = (uint)frame->entropy[neighbors];
  uint pair = 0;
  for (uint x = 0; x < RPF_VARIABLES; x = x == 2 ? RPF_FIRST_FEATURE : x + 1) {
    const uint end = x < RPF_POSITION ? RPF_VARIABLES : RPF_FIRST_FEATURE;
    for (uint y = RPF_POSITION; y < end; ++y, ++pair) {
      const uint joint = joint_entropy(frame->entropy, slot->planes + x * variable_planes, &margin[x],
                                       slot->planes + y * variable_planes, &margin[y], words, trace, pair);
      information[pair] = rpf_mutual_information((int)(joint - units[x] - units[y] + all), pass->entropy_slack,
                                                 pass->nats_per_unit, pass->information_bias, (float)neighbors);
    }
  }
}
