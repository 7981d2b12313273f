// Section 3: which samples a pixel is filtered with. A vector holds RPF_LANES variables of one record here.

// What the pixel's own samples say, in the order of place_of(). Moments and tolerances are of the features, relative to
// the shift. One vector more than there are features, for none is no size of an array.
typedef struct {
  float16 shift[RPF_CHUNKS];
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

// RPF_LANES variables of a record; places behind the last one are 0.
static float16 load_chunk(const Frame* frame, const rpf_pass* pass, uint sample, int chunk) {
  return frame->chunks[(size_t)chunk * pass->samples + (sample - pass->first_sample)];
}

static void feature_moments(const Frame* frame, const rpf_pass* pass, uint first, uint own, int chunk,
                            OwnMoments* out) {
  const float16 shift = out->shift[chunk];
  rpf_lanes16 sum;
  rpf_lanes_clear(&sum);
  int16 count = 0;
  for (uint j = 0; j < own; ++j) {
    const float16 value = load_chunk(frame, pass, first + j, chunk) - shift;
    rpf_lanes_add(&sum, j, rpf_or_zero(value));
    count += rpf_is_missing(value) ? 0 : 1;
  }
  const float16 number = convert_float16(count);
  const float16 mean = count == 0 ? 0.0f : rpf_lanes_total(&sum) / number;
  rpf_lanes_clear(&sum);
  for (uint j = 0; j < own; ++j) {
    const float16 off = (load_chunk(frame, pass, first + j, chunk) - shift) - mean;
    rpf_lanes_add(&sum, j, rpf_or_zero(off * off));
  }
  const float16 deviation = count == 0 ? 0.0f : sqrt(rpf_lanes_total(&sum) / number);
  const float16 tolerance =
      rpf_tolerance(vload16(chunk, frame->rejection_factor), deviation, vload16(chunk, frame->minimum_tolerance));
  out->mean[chunk] = mean;
  out->deviation[chunk] = deviation;
  out->tolerance[chunk] = count == 0 ? INFINITY : tolerance;
}

// The variables of the first own sample that has them, missing where none has; c' is not shifted.
static float16 shift_of(const Frame* frame, const rpf_pass* pass, uint first, uint own, int chunk) {
  const int16 is_variable = RPF_LANE_NUMBERS < RPF_VARIABLES - RPF_LANES * chunk;
  float16 shift = load_chunk(frame, pass, first, chunk);
#if RPF_MISSING
  for (uint i = 1; i < own; ++i) shift = rpf_is_missing(shift) ? load_chunk(frame, pass, first + i, chunk) : shift;
#endif
  return is_variable ? shift : 0.0f;
}

static void own_moments(const Frame* frame, const rpf_pass* pass, uint first, uint own, OwnMoments* out) {
  for (int c = 0; c < RPF_CHUNKS; ++c) out->shift[c] = shift_of(frame, pass, first, own, c);
  for (int c = 0; c < RPF_FEATURE_CHUNKS; ++c) feature_moments(frame, pass, first, own, c, out);
}

static int any_lane(int16 condition) {
#if defined(RPF_AVX2) && __has_builtin(__builtin_reduce_or)
  return __builtin_reduce_or(condition) != 0;  // a test of the comparison's mask; Oclgrind does not know it
#else
  const int8 a = condition.lo | condition.hi;
  const int4 b = a.lo | a.hi;
  return (b.x | b.y | b.z | b.w) != 0;
#endif
}

static int16 look_up(__global const char* offsets, uint16 index) {
  uint lane[RPF_LANES];
  char offset[RPF_LANES];
  vstore16(index, 0, lane);
#pragma unroll
  for (int l = 0; l < RPF_LANES; ++l) offset[l] = offsets[lane[l]];
  return convert_int16(vload16(0, offset));
}

// The samples that these words choose in these pixels. `failed` becomes -1 for empty pixels.
static uint16 choose_samples(const Frame* frame, const rpf_pass* pass, uint16 pixel, uint16 word, int16* failed) {
  if (RPF_SAMPLES > 0) return pixel * RPF_SAMPLES + mul_hi(word, (uint16)(RPF_SAMPLES));
  uint pixels[RPF_LANES], words[RPF_LANES];
  int skip[RPF_LANES];
  vstore16(pixel, 0, pixels);
  vstore16(word, 0, words);
  vstore16(*failed, 0, skip);
  for (int l = 0; l < RPF_LANES; ++l) {
    const uint samples = skip[l] ? 0 : samples_of(frame, pass, pixels[l]);
    words[l] = samples > 0 ? first_sample_of(frame, pass, pixels[l]) + rpf_choose(words[l], samples) : RPF_NO_SAMPLE;
  }
  const uint16 chosen = vload16(0, words);
  *failed = chosen == RPF_NO_SAMPLE;
  return chosen;
}

// One attempt of RPF_LANES draws. `failed`: the lanes that left the image or met an empty pixel.
static uint16 attempt_draws(const Frame* frame, const rpf_pass* pass, rpf_words16 words, int x, int y, int16* failed) {
  const int16 dx = look_up(frame->offsets, words.x & 0xFFFFu), dy = look_up(frame->offsets, words.x >> 16);
  const int16 to_x = x + dx, to_y = y + dy;
  *failed = (dx | dy) == 0 | to_x < 0 | to_x >= pass->width | to_y < 0 | to_y >= pass->height;
  return choose_samples(frame, pass, as_uint16(to_y) * (uint)pass->width + as_uint16(to_x), words.y, failed);
}

// Fills slot->candidates with draws begin .. end - 1; returns their number. RPF_LANES draws are made at once; those
// that fail try again.
static uint draw_candidates(const Frame* frame, const rpf_pass* pass, uint pixel, uint begin, uint end,
                            const Slot* slot) {
  const rpf_words key = rpf_draw_key(pass->seed, pass->pass, pixel);
  const int2 at = position_of(pass, pixel);
  const int x = at.x, y = at.y;
  uint count = 0;
  for (uint first = begin; first < end; first += RPF_LANES) {
    const uint16 draw = first + as_uint16(RPF_LANE_NUMBERS);
    int16 failed = -1;
    uint16 sample = RPF_NO_SAMPLE;
    for (uint attempt = 0; attempt < pass->attempts && any_lane(failed); ++attempt) {
      int16 failed_again;
      const uint16 next = attempt_draws(frame, pass, rpf_draw_words(key, draw, attempt), x, y, &failed_again);
      sample = failed ? next : sample;
      failed &= failed_again;
    }
    const int16 left_out = failed | (draw >= end);
    if (!any_lane(left_out)) {
      vstore16(sample, 0, slot->candidates + count);
      count += RPF_LANES;
      continue;
    }
    uint samples[RPF_LANES];
    vstore16(left_out ? RPF_NO_SAMPLE : sample, 0, samples);
    for (int l = 0; l < RPF_LANES; ++l) {
      slot->candidates[count] = samples[l];
      count += samples[l] != RPF_NO_SAMPLE;
    }
  }
  return count;
}

#ifdef RPF_AVX2  // Oclgrind does not know prefetches
// Asks for the records of the candidates: they lie all over the box, and all of them are needed soon.
static void fetch_candidates(const Frame* frame, const rpf_pass* pass, uint candidates, const Slot* slot) {
  __global const uint* sample = slot->candidates;
  const size_t stride = pass->samples;
  for (uint i = 0; i < candidates; ++i) {
    __global const float16* record = frame->chunks + (sample[i] - pass->first_sample);
#pragma unroll
    for (int c = 0; c < RPF_CHUNKS; ++c) __builtin_prefetch((const void*)(size_t)(record + c * stride));
  }
}
#endif

// Copies the records of neighbors begin .. end - 1, so that they lie side by side. It is load_chunk() in a loop, but
// for the pointers: the compiler would read them again after every store.
static void copy_records(const Frame* frame, const rpf_pass* pass, uint begin, uint end, const Slot* slot) {
  __global const uint* neighbors = slot->neighbors;
  __global const float16* chunks = frame->chunks;
  __global float16* records = slot->records;
  const size_t stride = pass->samples, capacity = pass->capacity;
  const uint first = pass->first_sample;
  for (uint j = begin; j < end; ++j) {
    const uint sample = neighbors[j] - first;
#pragma unroll
    for (int c = 0; c < RPF_CHUNKS; ++c) records[c * capacity + j] = chunks[c * stride + sample];
  }
}

static int is_accepted(const Frame* frame, const rpf_pass* pass, uint sample, const OwnMoments* own) {
  int16 rejected = 0;
#pragma unroll
  for (int c = 0; c < RPF_REJECTING_CHUNKS; ++c)
    rejected |= rpf_rejects(load_chunk(frame, pass, sample, c) - own->shift[c], own->mean[c], own->tolerance[c]);
  return !any_lane(rejected);
}

// Appends the accepted candidates in their order to the `before` neighbors there are. Returns the new number.
static uint append_accepted(const Frame* frame, const rpf_pass* pass, const OwnMoments* moments, uint candidates,
                            const Slot* slot, uint before) {
  uint count = before;
  for (uint i = 0; i < candidates; ++i) {
    const uint candidate = slot->candidates[i];
    slot->neighbors[count] = candidate;
    count += (uint)is_accepted(frame, pass, candidate, moments);
  }
  copy_records(frame, pass, before, count, slot);
  return count;
}

// Fills slot->neighbors and slot->records: the own samples, then the accepted candidates in the order of the draws.
// Returns N; `drawn` becomes the number of candidates.
static uint gather(const Frame* frame, const rpf_pass* pass, uint pixel, uint first, uint own,
                   const OwnMoments* moments, const Slot* slot, uint* drawn) {
  const uint draws = frame->draws[own];
  for (uint i = 0; i < own; ++i) slot->neighbors[i] = first + i;
  copy_records(frame, pass, 0, own, slot);
  uint count = own;
  *drawn = 0;
  for (uint begin = 0; begin < draws; begin += RPF_DRAWN_AT_ONCE) {
    const uint candidates = draw_candidates(frame, pass, pixel, begin, min(begin + RPF_DRAWN_AT_ONCE, draws), slot);
#ifdef RPF_AVX2
    fetch_candidates(frame, pass, candidates, slot);
#endif
    if (RPF_PHASES > 1) count = append_accepted(frame, pass, moments, candidates, slot, count);
    *drawn += candidates;
  }
  return count;
}

// What no own sample has is shifted by the first neighbor that has it, by 0 where none has.
static void settle_shift(const rpf_pass* pass, uint neighbors, const Slot* slot, OwnMoments* moments) {
  for (int c = 0; c < RPF_CHUNKS; ++c) {
    float16 shift = moments->shift[c];
#if RPF_MISSING
    for (uint j = 0; j < neighbors && any_lane(rpf_is_missing(shift)); ++j)
      shift = rpf_is_missing(shift) ? slot->records[c * pass->capacity + j] : shift;
#endif
    moments->shift[c] = rpf_or_zero(shift);
  }
}
