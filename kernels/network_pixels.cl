// What the learned estimator sees of pixels: moments over their samples.

// Where a row's values go.
typedef struct {
  __global float *entered, *guides, *albedo;
  __global float* traced;          // what the first layer reads, where somebody wants it; else 0
  int guides_plane, albedo_plane;  // floats from one plane to the next
} RowOut;

// The first layer of a pixel, and what it reads of it.
typedef struct {
  __global const float *weights, *bias;
} Enter;

// All that is known of pixel x is 0.
static void no_samples(const Enter* layer, const RowOut* out, int x) {
  for (int k = 0; k < RPF_ENTER_STRIDE; k += 8)
    vstore8(rpf_leaky(vload8(0, layer->bias + k)), 0, out->entered + x * RPF_ENTER_STRIDE + k);
  for (int k = 0; out->traced != 0 && k < RPF_PIXEL_STRIDE; ++k) out->traced[x * RPF_PIXEL_STRIDE + k] = 0.0f;
  for (int k = 0; k < RPF_GUIDES; ++k) out->guides[k * out->guides_plane + x] = 0.0f;
  for (int k = 0; k < RPF_ALBEDO_SUMS; ++k) out->albedo[k * out->albedo_plane + x] = 0.0f;
}

// Moments of RPF_LANES values over the samples of a pixel.
typedef struct {
  float16 first, sum, squares;
} Moments;

static Moments moments_from(float16 first) {
  Moments m;
  m.first = first;
  m.sum = 0.0f;
  m.squares = 0.0f;
  return m;
}

static void add_to_moments(Moments* m, float16 value) {
  const float16 d = value - m->first;
  m->sum += d;
  m->squares = fma(d, d, m->squares);
}

#define RPF_FEATURE_VECTORS ((RPF_SAMPLE_FEATURES + RPF_LANES - 1) / RPF_LANES)

// Of a pixel: of its features, of what is computed of its samples, and of the first values of their records.
typedef struct {
  Moments features[RPF_FEATURE_VECTORS], seen, records;
} PixelMoments;

// The first sample of a pixel counts as 0 everywhere: it is left out.
static void add_stretch(const Samples* samples, const Stretch* stretch, PixelMoments* pixel) {
  for (uint v = 0; v < RPF_FEATURE_VECTORS; ++v) {
    const float* values = samples->features + v * RPF_LANES;
    Moments m =
        stretch->begins ? moments_from(vload16(0, values + stretch->from * RPF_FEATURE_STRIDE)) : pixel->features[v];
    for (uint s = stretch->from + stretch->begins; s < stretch->to; ++s)
      add_to_moments(&m, vload16(0, values + s * RPF_FEATURE_STRIDE));
    pixel->features[v] = m;
  }
  Moments seen = stretch->begins ? moments_from(vload16(stretch->from, samples->seen)) : pixel->seen;
  Moments records = stretch->begins ? moments_from(vload16(stretch->from, samples->records)) : pixel->records;
  for (uint s = stretch->from + stretch->begins; s < stretch->to; ++s) {
    add_to_moments(&seen, vload16(s, samples->seen));
    add_to_moments(&records, vload16(s, samples->records));
  }
  pixel->seen = seen;
  pixel->records = records;
}

static float16 mean_of(const Moments* m, float share) { return rpf_shifted_mean(m->first, m->sum, share); }
static float16 variance_of(const Moments* m, float share) { return rpf_shifted_variance(m->sum, m->squares, share); }

// Pixels side by side in a row whose statistics are made at once: `count` of them, at most RPF_LANES, from x on. In the
// lanes behind them is whatever was there before.
typedef struct {
  int x, count;
  float16 seen[RPF_LANES], records[RPF_LANES], spreads[RPF_LANES];  // means, means, variances of the records
  float luminances[RPF_LANES], samples[RPF_LANES];                  // variances; counts
  float pixels[RPF_LANES * RPF_PIXEL_STRIDE];                       // what the first layer reads
} Batch;

// Means and deviations of the features. What is stored beyond them is written over by what comes next.
static void finish_features(const PixelMoments* pixel, float share, float* cell) {
  for (uint v = 0; v < RPF_FEATURE_VECTORS; ++v) vstore16(mean_of(&pixel->features[v], share), v, cell);
  for (uint v = 0; v < RPF_FEATURE_VECTORS; ++v)
    vstore16(rpf_feature_deviation(variance_of(&pixel->features[v], share)), v, cell + RPF_SAMPLE_FEATURES);
}

static float16 of_column(const float16* columns, int column) { return column < 0 ? 0.0f : columns[column]; }

// Of RPF_LANES pixels. `columns`: of the guides among the first values of records; -1 for a guide that is 0.
static void find_statistics(Batch* batch, __global const int* columns, float16* statistics) {
  const float16 samples = vload16(0, batch->samples);
  transpose(batch->seen);
  transpose(batch->records);
  transpose(batch->spreads);
  for (int i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_BRIGHTNESS + i] = rpf_brightness(batch->seen[RPF_SEEN_COLOR + i]);
  statistics[RPF_STATISTIC_ERROR] =
      rpf_relative_error(vload16(0, batch->luminances), batch->seen[RPF_SEEN_LUMINANCE], samples);
  for (int k = 0; k < RPF_GUIDES; ++k) statistics[RPF_STATISTIC_GUIDES + k] = of_column(batch->records, columns[k]);
  for (int i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_SPREADS + i] =
        sqrt(of_column(batch->spreads, columns[3 * i]) + of_column(batch->spreads, columns[3 * i + 1]) +
             of_column(batch->spreads, columns[3 * i + 2]));
  statistics[RPF_STATISTIC_SAMPLES] = 1.0f / sqrt(samples);
}

// Stores the first `count` lanes.
static void store_lanes(float16 values, int count, __global float* to) {
  if (count == RPF_LANES) {
    vstore16(values, 0, to);
    return;
  }
  float lanes[RPF_LANES];
  vstore16(values, 0, lanes);
  for (int i = 0; i < count; ++i) to[i] = lanes[i];
}

// The first layer of the pixels at hand.
static void enter_batch(const Batch* batch, const Enter* layer, const RowOut* out) {
  float entered[RPF_LANES * RPF_ENTER_STRIDE];
  enter(batch->pixels, layer->weights, layer->bias, entered, batch->count);
  __global float* to = out->entered + batch->x * RPF_ENTER_STRIDE;
  for (int k = 0; k < batch->count * RPF_ENTER_STRIDE; k += 8) vstore8(vload8(0, entered + k), 0, to + k);
  for (int k = 0; out->traced != 0 && k < batch->count * RPF_PIXEL_STRIDE; ++k)
    out->traced[batch->x * RPF_PIXEL_STRIDE + k] = batch->pixels[k];
}

// Statistics, guides and albedo of the pixels at hand, then their first layer. A call: inlined in four places Intel's
// compiler took 20 s for it.
__attribute__((noinline)) static void finish_batch(Batch* batch, __global const int* guide_columns, const Enter* layer,
                                                   const RowOut* out) {
  float16 statistics[RPF_STATISTICS];
  if (batch->count == 0) return;
  find_statistics(batch, guide_columns, statistics);
  for (int k = 0; k < RPF_GUIDES; ++k)
    store_lanes(statistics[RPF_STATISTIC_GUIDES + k], batch->count, out->guides + k * out->guides_plane + batch->x);
  for (int i = 0; i < RPF_ALBEDO_SUMS; ++i)
    store_lanes(i < 3 ? batch->seen[RPF_SEEN_BASE + i] : 1.0f, batch->count,
                out->albedo + i * out->albedo_plane + batch->x);
  float* cell = batch->pixels + 2 * RPF_SAMPLE_FEATURES;
  float rest[(RPF_STATISTICS - RPF_LANES) * RPF_LANES];
  for (int k = RPF_LANES; k < RPF_STATISTICS; ++k) vstore16(statistics[k], k - RPF_LANES, rest);
  transpose(statistics);
  for (int i = 0; i < batch->count; ++i, cell += RPF_PIXEL_STRIDE) {
    vstore16(statistics[i], 0, cell);
    for (int k = RPF_LANES; k < RPF_STATISTICS; ++k) cell[k] = rest[(k - RPF_LANES) * RPF_LANES + i];
  }
  enter_batch(batch, layer, out);
  batch->x += batch->count;
  batch->count = 0;
}

static void finish_pixel(const PixelMoments* pixel, uint count, __global const int* guide_columns, const Enter* layer,
                         const RowOut* out, Batch* batch) {
  const float samples = (float)count, share = 1.0f / samples;
  float variances[RPF_SEEN];
  vstore16(variance_of(&pixel->seen, share), 0, variances);
  const int i = batch->count++;
  finish_features(pixel, share, batch->pixels + i * RPF_PIXEL_STRIDE);
  batch->seen[i] = mean_of(&pixel->seen, share);
  batch->records[i] = mean_of(&pixel->records, share);
  batch->spreads[i] = variance_of(&pixel->records, share);
  batch->luminances[i] = variances[RPF_SEEN_LUMINANCE];
  batch->samples[i] = samples;
  if (batch->count == RPF_LANES) finish_batch(batch, guide_columns, layer, out);
}

// Pixel x has no samples.
static void leave_pixel(Batch* batch, __global const int* guide_columns, const Enter* layer, const RowOut* out, int x) {
  finish_batch(batch, guide_columns, layer, out);
  batch->x = x + 1;
  no_samples(layer, out, x);
}

// The first layer of pixels, their guides and albedo. `kept`: what sum() will need of their samples, `pixels`: what the
// layer reads; no rows where nobody wants it.
__kernel void see(__global const float* records, __global const int* base_columns, __global const int* input_columns,
                  __global const float* weights1, __global const float* bias1, __global const float* weights2,
                  __global const float* bias2, __global const uint* first_sample, __global const int* guide_columns,
                  __global const float* enter_weights, __global const float* enter_bias, __global float* entered,
                  __global float* guides, __global float* albedo, __global float* kept, __global float* pixels,
                  __global float* trace, const rpf_samples l, const rpf_grid entered_grid, const rpf_grid guide_grid,
                  const rpf_grid albedo_grid, const rpf_grid kept_grid, const rpf_grid pixel_grid) {
  const Seeing of = {records, base_columns, input_columns, weights1, bias1, weights2, bias2};
  const Enter layer = {enter_weights, enter_bias};
  RowOut out;
  out.traced = 0;
  out.guides_plane = plane_of(&guide_grid, RPF_GUIDES);
  out.albedo_plane = plane_of(&albedo_grid, RPF_ALBEDO_SUMS);
  Samples samples;
  PixelMoments pixel;
  Batch batch;
  const int parts = l.end_part - l.first_part, end_of_share = l.first_part + share_of(parts, get_global_id(0) + 1);
  for (int i = l.first_part + share_of(parts, get_global_id(0)); i < end_of_share; ++i) {
    const Part part = part_of_launch(first_sample, &l, i);
    __global float* albedo_row = albedo + row_at(&albedo_grid, part.y);
    out.entered = entered + row_at(&entered_grid, part.y) + RPF_BORDER * RPF_ENTER_STRIDE;
    if (pixel_grid.rows > 0) out.traced = pixels + row_at(&pixel_grid, part.y) + RPF_BORDER * RPF_PIXEL_STRIDE;
    out.guides = guides + row_at(&guide_grid, part.y) + RPF_MARGIN;
    out.albedo = albedo_row + RPF_MARGIN;
    close_planes(albedo_row, out.albedo_plane, RPF_ALBEDO_SUMS, part.begin, part.end, l.area.width, -0.0f);
    int x = part.begin;  // the first pixel that is not finished
    batch.x = x;
    batch.count = 0;
    const uint end = first_of_pixel(&part, part.end);
    for (uint first = first_of_pixel(&part, x); first < end; first += RPF_SAMPLES_AT_ONCE) {
      see_samples(&of, &l, first, min(end - first, (uint)RPF_SAMPLES_AT_ONCE), &samples);
      if (l.is_traced) keep_samples(&samples, trace);
      if (kept_grid.rows > 0) keep_for_sum(&samples, kept + kept_at(&kept_grid, &part, first));
      for (uint s = 0; s < samples.count;) {
        const Stretch stretch = stretch_of(&part, x, &samples, s);
        for (; x < stretch.x; ++x) leave_pixel(&batch, guide_columns, &layer, &out, x);
        add_stretch(&samples, &stretch, &pixel);
        if (stretch.ends)
          finish_pixel(&pixel, first_of_pixel(&part, x + 1) - first_of_pixel(&part, x), guide_columns, &layer, &out,
                       &batch);
        x += stretch.ends;
        s = stretch.to;
      }
    }
    finish_batch(&batch, guide_columns, &layer, &out);
    for (; x < part.end; ++x) no_samples(&layer, &out, x);
    close_row(out.entered, RPF_ENTER_STRIDE, part.begin, part.end, l.area.width);
  }
}
