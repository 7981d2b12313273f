// Samples in the learned estimator: what is computed of them, their features, and which pixel they belong to. A
// work-item takes parts of rows of pixels, and their samples RPF_SAMPLES_AT_ONCE at once: what is made of them stays in
// the processor's first cache. Pixels begin and end anywhere between.

// What of the frame a work-item reads, and of the network.
typedef struct {
  __global const float* records;      // [sample][variables]
  __global const int* base_columns;   // of albedo and miss
  __global const int* input_columns;  // of what the network sees of records
  __global const float *weights1, *bias1, *weights2, *bias2;
} Seeing;

// What is made of samples, and of how many.
typedef struct {
  float records[RPF_SAMPLES_AT_ONCE * RPF_LANES];  // the first values of each
  float seen[RPF_SAMPLES_AT_ONCE * RPF_SEEN];
  float hidden[RPF_SAMPLES_AT_ONCE * RPF_HIDDEN_STRIDE];
  float features[RPF_SAMPLES_AT_ONCE * RPF_FEATURE_STRIDE];  // there is room for the context behind them
  uint first, count;                                         // of those that the launch has records of
} Samples;

// Layers over samples, generated behind this text (src/opencl/layer_blocking.cpp): from what is computed and columns of
// records to features, and from features with their context to what weight2 reads. They may also write behind the last
// sample, up to a multiple of RPF_CELLS.
static void sample1(const float* computed, __global const float* records, __global const int* columns, int inputs,
                    int variables, __global const float* weights, __global const float* bias, float* out, int count);
static void sample2(const float* own, __global const float* weights, __global const float* bias, float* out, int count);
static void weight1(const float* own, __global const float* weights, __global const float* bias, float* out, int count);
// The same over pixels side by side, [pixel][RPF_PIXEL_STRIDE] to [pixel][RPF_ENTER_STRIDE].
static void enter(const float* own, __global const float* weights, __global const float* bias, float* out, int count);

// The first RPF_LANES values of RPF_LANES records; zeros for those behind the launch's last one, where there is nothing
// to be read.
static void load_records(const Seeing* of, const rpf_samples* l, uint first, float16* rows) {
  const size_t stride = (size_t)l->variables, end = (size_t)l->samples * stride;
  __global const float* next = of->records + (size_t)(first + RPF_SAMPLES_AT_ONCE) * stride;
  for (int k = 0; k < RPF_LANES * l->variables; k += RPF_LANES) ask_for(next + k);
  if ((size_t)(first + RPF_LANES - 1) * stride + RPF_LANES <= end) {
#pragma unroll
    for (uint i = 0; i < RPF_LANES; ++i) rows[i] = vload16(0, of->records + (size_t)(first + i) * stride);
    return;
  }
  for (uint i = 0; i < RPF_LANES; ++i) {
    const size_t begin = (size_t)(first + i) * stride;
    float values[RPF_LANES];
    for (size_t k = 0; k < RPF_LANES; ++k) values[k] = begin + k < end ? of->records[begin + k] : 0.0f;
    rows[i] = vload16(0, values);
  }
}

// What is computed of RPF_LANES samples. `columns`: the first values of their records, among which are color, albedo
// and miss.
static void compute_inputs(const Seeing* of, const rpf_samples* l, float16* columns, float* seen) {
  float16 rows[RPF_LANES];
  transpose(columns);
  const float16 miss = of->base_columns[3] < 0 ? 0.0f : columns[of->base_columns[3]];
#pragma unroll
  for (int i = 0; i < 3; ++i) {
    const float16 color = rpf_seen_color(columns[i], l->exposure);
    const float16 base = l->has_albedo ? rpf_albedo_base(columns[of->base_columns[i]], miss) : 1.0f;
    rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS + i] = rpf_brightness(color);
    rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS_OVER + i] = rpf_brightness_over(color, base);
    rows[RPF_SEEN_COLOR + i] = color;
    rows[RPF_SEEN_BASE + i] = base;
    rows[RPF_SEEN_RADIANCE + i] = columns[i];
  }
  rows[RPF_SEEN_LUMINANCE] = rpf_luminance(rows[RPF_SEEN_COLOR], rows[RPF_SEEN_COLOR + 1], rows[RPF_SEEN_COLOR + 2]);
  transpose(rows);
#pragma unroll
  for (int i = 0; i < RPF_LANES; ++i) vstore16(rows[i], (size_t)i, seen);
}

// Computed inputs and features of `count` samples from `first` on.
static void see_samples(const Seeing* of, const rpf_samples* l, uint first, uint count, Samples* samples) {
  samples->first = first;
  samples->count = count;
  for (uint s = 0; s < count; s += RPF_LANES) {
    float16 rows[RPF_LANES];
    load_records(of, l, first + s, rows);
#pragma unroll
    for (uint i = 0; i < RPF_LANES; ++i) vstore16(rows[i], s + i, samples->records);
    compute_inputs(of, l, rows, samples->seen + s * RPF_SEEN);
  }
  sample1(samples->seen, of->records + (size_t)first * (size_t)l->variables, of->input_columns, l->inputs, l->variables,
          of->weights1, of->bias1, samples->hidden, (int)count);
  sample2(samples->hidden, of->weights2, of->bias2, samples->features, (int)count);
}

// [sample][RPF_SEEN computed, then hidden, then features]
static void keep_samples(const Samples* samples, __global float* trace) {
  const size_t stride = RPF_SEEN + 2 * RPF_HIDDEN_STRIDE;
  for (uint s = 0; s < samples->count; ++s) {
    __global float* out = trace + (size_t)(samples->first + s) * stride;
    for (uint k = 0; k < RPF_SEEN; ++k) out[k] = samples->seen[s * RPF_SEEN + k];
    for (uint k = 0; k < RPF_HIDDEN_STRIDE; ++k) {
      out[RPF_SEEN + k] = samples->hidden[s * RPF_HIDDEN_STRIDE + k];
      out[RPF_SEEN + RPF_HIDDEN_STRIDE + k] = samples->features[s * RPF_FEATURE_STRIDE + k];
    }
  }
}

// What sum() needs of samples, where there is room to keep it: [sample][features, then what is summed].
#define RPF_KEPT (RPF_HIDDEN_STRIDE + 8)

// What stands there for the next samples, to be read or written.
static void ask_for_kept(__global const float* kept) {
  for (uint k = 0; k < RPF_KEPT; k += 16) ask_for(kept + RPF_SAMPLES_AT_ONCE * RPF_KEPT + k);
}

static void keep_for_sum(const Samples* samples, __global float* kept) {
  for (uint s = 0; s < samples->count; ++s, kept += RPF_KEPT) {
    ask_for_kept(kept);
    for (uint k = 0; k < RPF_HIDDEN_STRIDE; k += 8)
      vstore8(vload8(0, samples->features + s * RPF_FEATURE_STRIDE + k), 0, kept + k);
    vstore8(vload8(0, samples->seen + s * RPF_SEEN + RPF_SEEN_SUMMED), 0, kept + RPF_HIDDEN_STRIDE);
  }
}

// `count` samples from `first` on as keep_for_sum() left them; the rest of what is computed of them is not there.
static void kept_samples(__global const float* kept, uint first, uint count, Samples* samples) {
  samples->first = first;
  samples->count = count;
  for (uint s = 0; s < count; ++s, kept += RPF_KEPT) {
    ask_for_kept(kept);
    for (uint k = 0; k < RPF_HIDDEN_STRIDE; k += 8)
      vstore8(vload8(0, kept + k), 0, samples->features + s * RPF_FEATURE_STRIDE + k);
    vstore8(vload8(0, kept + RPF_HIDDEN_STRIDE), 0, samples->seen + s * RPF_SEEN + RPF_SEEN_SUMMED);
  }
}

// ---- where pixels begin and end -------------------------------------------------------------------------------------

// A part of a row of pixels: where each begins among the samples of the launch.
typedef struct {
  int y, begin, end;
  __global const uint* first_sample;  // of the row's pixels, in the frame
  uint first_of_launch;
} Part;

static Part part_of_launch(__global const uint* first_sample, const rpf_samples* l, int i) {
  Part part;
  part.y = row_of_part(&l->area, i);
  part.begin = begin_of_part(&l->area, i);
  part.end = end_of_part(&l->area, i);
  part.first_sample = first_sample + (size_t)(part.y - l->area.first) * (size_t)l->frame_width;
  part.first_of_launch = l->first_sample;
  return part;
}

static uint first_of_pixel(const Part* part, int x) { return part->first_sample[x] - part->first_of_launch; }

// Where a sample stands in a grid of rows of samples.
static size_t kept_at(const rpf_grid* grid, const Part* part, uint sample) {
  return row_at(grid, part->y) + (size_t)(sample - first_of_pixel(part, 0)) * RPF_KEPT;
}

// Samples from .. to - 1, of those at hand, of pixel x: all of them, or some where a pixel has more than are at hand.
typedef struct {
  int x;
  uint from, to;
  bool begins, ends;
} Stretch;

// Of the pixel that the sample after `from` others belongs to. Pixels without samples are passed over.
static Stretch stretch_of(const Part* part, int x, const Samples* samples, uint from) {
  Stretch stretch;
  const uint sample = samples->first + from;
  while (first_of_pixel(part, x + 1) <= sample) ++x;
  const uint end = first_of_pixel(part, x + 1) - samples->first;
  stretch.x = x;
  stretch.from = from;
  stretch.to = min(end, samples->count);
  stretch.begins = first_of_pixel(part, x) == sample;
  stretch.ends = end <= samples->count;
  return stretch;
}
