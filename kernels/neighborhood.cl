// Section 3: which samples a pixel is filtered with. A vector holds RPF_LANES variables of one record here.

// What the pixel's own samples say. Moments and tolerances are of the features, relative to the shift. One vector more
// than there are features, for none is no size of an array.
typedef struct {
  float16 shift[RPF_CHUNKS];
  float16 feature_shift[RPF_FEATURE_CHUNKS + 1];
  float16 mean[RPF_FEATURE_CHUNKS + 1], deviation[RPF_FEATURE_CHUNKS + 1], tolerance[RPF_FEATURE_CHUNKS + 1];
} OwnMoments;

static uint first_sample_of(const Frame* frame, const rpf_pass* pass, uint pixel) {
  return RPF_SAMPLES > 0 ? pixel * RPF_SAMPLES : frame->first_sample[pixel - pass->first_pixel];
}

static uint samples_of(const Frame* frame, const rpf_pass* pass, uint pixel) {
  if (RPF_SAMPLES > 0) return RPF_SAMPLES;
  const uint p = pixel - pass->first_pixel;
  return frame->first_sample[p + 1] - frame->first_sample[p];
}

// RPF_LANES variables of a record from `variable` on; behind the last one follow values that mean nothing.
static float16 load_record(const Frame* frame, const rpf_pass* pass, uint sample, int variable) {
  return vload16(0, frame->records + (size_t)(sample - pass->first_sample) * RPF_VARIABLES + variable);
}

static float16 load_features(const Frame* frame, const rpf_pass* pass, uint sample, int chunk) {
  return load_record(frame, pass, sample, RPF_FIRST_FEATURE + RPF_LANES * chunk);
}

static void feature_moments(const Frame* frame, const rpf_pass* pass, uint first, uint own, int chunk,
                            OwnMoments* out) {
  const float16 shift = rpf_or_zero(load_features(frame, pass, first, chunk));
  rpf_lanes16 sum;
  rpf_lanes_clear(&sum);
  int16 count = 0;
  for (uint j = 0; j < own; ++j) {
    const float16 value = load_features(frame, pass, first + j, chunk) - shift;
    rpf_lanes_add(&sum, j, rpf_or_zero(value));
    count += rpf_is_missing(value) ? 0 : 1;
  }
  const float16 number = convert_float16(count);
  const float16 mean = count == 0 ? 0.0f : rpf_lanes_total(&sum) / number;
  rpf_lanes_clear(&sum);
  for (uint j = 0; j < own; ++j) {
    const float16 off = (load_features(frame, pass, first + j, chunk) - shift) - mean;
    rpf_lanes_add(&sum, j, rpf_or_zero(off * off));
  }
  const float16 deviation = count == 0 ? 0.0f : sqrt(rpf_lanes_total(&sum) / number);
  const float16 tolerance =
      rpf_tolerance(vload16(chunk, frame->rejection_factor), deviation, vload16(chunk, frame->minimum_tolerance));
  out->feature_shift[chunk] = shift;
  out->mean[chunk] = mean;
  out->deviation[chunk] = deviation;
  out->tolerance[chunk] = count == 0 ? INFINITY : tolerance;
}

static void own_moments(const Frame* frame, const rpf_pass* pass, uint first, uint own, OwnMoments* out) {
  for (int c = 0; c < RPF_CHUNKS; ++c) out->shift[c] = rpf_or_zero(load_record(frame, pass, first, RPF_LANES * c));
  for (int c = 0; c < RPF_FEATURE_CHUNKS; ++c) feature_moments(frame, pass, first, own, c, out);
}

// The sample that these words draw; RPF_NO_SAMPLE where they leave the image or meet an empty pixel.
static uint drawn_sample(const Frame* frame, const rpf_pass* pass, int x, int y, uint place, uint choice) {
  const int dx = frame->offsets[place & 0xFFFFu], dy = frame->offsets[place >> 16];
  const int to_x = x + dx, to_y = y + dy;
  if ((dx == 0 && dy == 0) || to_x < 0 || to_x >= pass->width || to_y < 0 || to_y >= pass->height) return RPF_NO_SAMPLE;
  const uint pixel = (uint)to_y * (uint)pass->width + (uint)to_x;
  const uint samples = samples_of(frame, pass, pixel);
  return samples > 0 ? first_sample_of(frame, pass, pixel) + rpf_choose(choice, samples) : RPF_NO_SAMPLE;
}

// The attempts of a draw behind the first one.
static uint draw_again(const Frame* frame, const rpf_pass* pass, rpf_words key, int x, int y, uint draw) {
  uint sample = RPF_NO_SAMPLE;
  for (uint attempt = 1; attempt < pass->attempts && sample == RPF_NO_SAMPLE; ++attempt) {
    const rpf_words words = rpf_draw_words(key, draw, attempt);
    sample = drawn_sample(frame, pass, x, y, words.x, words.y);
  }
  return sample;
}

// Fills slot->candidates; returns their number. The words of RPF_LANES draws are made at once.
static uint draw_candidates(const Frame* frame, const rpf_pass* pass, uint pixel, uint own, const Slot* slot) {
  const rpf_words key = rpf_draw_key(pass->seed, pass->pass, pixel);
  const int x = (int)(pixel % (uint)pass->width), y = (int)(pixel / (uint)pass->width);
  const uint draws = frame->draws[own];
  uint count = 0;
  for (uint begin = 0; begin < draws; begin += RPF_LANES) {
    const rpf_words16 words = rpf_draw_words(key, begin + as_uint16(RPF_LANE_NUMBERS), 0);
    uint place[RPF_LANES], choice[RPF_LANES];
    vstore16(words.x, 0, place);
    vstore16(words.y, 0, choice);
    const uint lanes = min(draws - begin, (uint)RPF_LANES);
    for (uint l = 0; l < lanes; ++l) {
      uint candidate = drawn_sample(frame, pass, x, y, place[l], choice[l]);
      if (candidate == RPF_NO_SAMPLE) candidate = draw_again(frame, pass, key, x, y, begin + l);
      slot->candidates[count] = candidate;
      count += candidate != RPF_NO_SAMPLE;
    }
  }
  return count;
}

static int any_lane(int16 condition) {
  const int8 a = condition.lo | condition.hi;
  const int4 b = a.lo | a.hi;
  const int2 c = b.lo | b.hi;
  return (c.x | c.y) != 0;
}

static int is_accepted(const Frame* frame, const rpf_pass* pass, uint sample, const OwnMoments* own) {
  int16 rejected = 0;
#pragma unroll
  for (int c = 0; c < RPF_REJECTING_CHUNKS; ++c)
    rejected |=
        rpf_rejects(load_features(frame, pass, sample, c) - own->feature_shift[c], own->mean[c], own->tolerance[c]);
  return !any_lane(rejected);
}

// Fills slot->neighbors: the own samples, then the accepted candidates in the order of the draws. Returns N.
static uint gather(const Frame* frame, const rpf_pass* pass, uint first, uint own, const OwnMoments* moments,
                   uint candidates, const Slot* slot) {
  for (uint i = 0; i < own; ++i) slot->neighbors[i] = first + i;
  uint count = own;
  for (uint i = 0; i < candidates; ++i) {
    const uint candidate = slot->candidates[i];
    slot->neighbors[count] = candidate;
    count += (uint)is_accepted(frame, pass, candidate, moments);
  }
  return count;
}

static float16 interleave(float8 even, float8 odd) {
  float16 both;
  both.even = even;
  both.odd = odd;
  return both;
}

// 16 rows become 16 columns: each of four rounds interleaves row i with row i + 8, which rotates the bits of an
// element's place (row, column) by one.
static void transpose(float16* rows) {
#pragma unroll
  for (int round = 0; round < 4; ++round) {
    float16 mixed[RPF_LANES];
#pragma unroll
    for (int i = 0; i < RPF_LANES / 2; ++i) {
      mixed[2 * i] = interleave(rows[i].lo, rows[i + 8].lo);
      mixed[2 * i + 1] = interleave(rows[i].hi, rows[i + 8].hi);
    }
#pragma unroll
    for (int i = 0; i < RPF_LANES; ++i) rows[i] = mixed[i];
  }
}

// Records to columns, less the shift. Behind the last neighbor all values are missing, so that sums leave them out.
static void fill_columns(const Frame* frame, const rpf_pass* pass, uint neighbors, const OwnMoments* moments,
                         const Slot* slot) {
  for (uint block = 0; block * RPF_LANES < neighbors; ++block)
    for (int c = 0; c < RPF_CHUNKS; ++c) {
      float16 rows[RPF_LANES];
#pragma unroll
      for (uint l = 0; l < RPF_LANES; ++l) {
        const uint j = block * RPF_LANES + l;
        rows[l] = NAN;
        if (j < neighbors) rows[l] = load_record(frame, pass, slot->neighbors[j], RPF_LANES * c) - moments->shift[c];
      }
      transpose(rows);
#pragma unroll
      for (int v = 0; v < RPF_LANES; ++v)
        if (RPF_LANES * c + v < RPF_VARIABLES) slot->columns[(RPF_LANES * c + v) * slot->blocks + block] = rows[v];
    }
}
