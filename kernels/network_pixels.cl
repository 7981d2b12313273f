// What the learned estimator sees of pixels: moments over their samples.

// Where a row's values go.
typedef struct {
  __global float *cells, *guides, *albedo;
  int cell_stride, guides_plane, albedo_plane;  // floats from one cell or plane to the next
} RowOut;

static void no_samples(const RowOut* out, int x) {
  for (uint k = 0; k < rpf_pixel_values(RPF_SAMPLE_FEATURES); ++k) out->cells[x * out->cell_stride + (int)k] = 0.0f;
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
static void add_stretch(const Seeing* of, const rpf_samples* l, const Samples* samples, const Stretch* stretch,
                        PixelMoments* pixel) {
  for (uint v = 0; v < RPF_FEATURE_VECTORS; ++v) {
    const float* values = samples->features + v * RPF_LANES;
    Moments m =
        stretch->begins ? moments_from(vload16(0, values + stretch->from * RPF_FEATURE_STRIDE)) : pixel->features[v];
    for (uint s = stretch->from + stretch->begins; s < stretch->to; ++s)
      add_to_moments(&m, vload16(0, values + s * RPF_FEATURE_STRIDE));
    pixel->features[v] = m;
  }
  Moments seen = stretch->begins ? moments_from(vload16(stretch->from, samples->seen)) : pixel->seen;
  Moments records =
      stretch->begins ? moments_from(begin_of_record(of->records, l, samples->first + stretch->from)) : pixel->records;
  for (uint s = stretch->from + stretch->begins; s < stretch->to; ++s) {
    add_to_moments(&seen, vload16(s, samples->seen));
    add_to_moments(&records, begin_of_record(of->records, l, samples->first + s));
  }
  pixel->seen = seen;
  pixel->records = records;
}

static float16 mean_of(const Moments* m, float samples) { return rpf_shifted_mean(m->first, m->sum, samples); }
static float16 variance_of(const Moments* m, float samples) {
  return rpf_shifted_variance(m->sum, m->squares, samples);
}

// Means and deviations of the features.
static void finish_features(const PixelMoments* pixel, float samples, __global float* cell) {
  for (uint v = 0; v < RPF_FEATURE_VECTORS; ++v) {
    float means[RPF_LANES], deviations[RPF_LANES];
    vstore16(mean_of(&pixel->features[v], samples), 0, means);
    vstore16(rpf_feature_deviation(variance_of(&pixel->features[v], samples)), 0, deviations);
    for (uint k = 0; k < RPF_LANES && v * RPF_LANES + k < RPF_SAMPLE_FEATURES; ++k) {
      cell[v * RPF_LANES + k] = means[k];
      cell[RPF_SAMPLE_FEATURES + v * RPF_LANES + k] = deviations[k];
    }
  }
}

// Statistics of the radiance, and the mean of a.
static void finish_color(const Moments* seen, float samples, const RowOut* out, int x, __global float* statistics) {
  float mean[RPF_SEEN], variance[RPF_SEEN], brightness[RPF_SEEN];
  const float16 means = mean_of(seen, samples);
  vstore16(means, 0, mean);
  vstore16(rpf_brightness(means), 0, brightness);
  vstore16(variance_of(seen, samples), 0, variance);
  for (int i = 0; i < 3; ++i) {
    statistics[RPF_STATISTIC_BRIGHTNESS + i] = brightness[RPF_SEEN_COLOR + i];
    out->albedo[i * out->albedo_plane + x] = mean[RPF_SEEN_BASE + i];
  }
  out->albedo[3 * out->albedo_plane + x] = 1.0f;
  statistics[RPF_STATISTIC_ERROR] = rpf_relative_error(variance[RPF_SEEN_LUMINANCE], mean[RPF_SEEN_LUMINANCE], samples);
  statistics[RPF_STATISTIC_SAMPLES] = 1.0f / sqrt(samples);
}

static float of_column(const float* values, int column) { return column < 0 ? 0.0f : values[column]; }

// Means of the guides and their spreads. `columns`: among the first RPF_LANES values of records; -1 for a guide that
// is 0.
static void finish_guides(const Moments* records, __global const int* columns, float samples, const RowOut* out, int x,
                          __global float* statistics) {
  float mean[RPF_LANES], variance[RPF_LANES];
  vstore16(mean_of(records, samples), 0, mean);
  vstore16(variance_of(records, samples), 0, variance);
  for (int k = 0; k < RPF_GUIDES; ++k) {
    const float value = of_column(mean, columns[k]);
    statistics[RPF_STATISTIC_GUIDES + k] = value;
    out->guides[k * out->guides_plane + x] = value;
  }
  for (int i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_SPREADS + i] =
        sqrt(of_column(variance, columns[3 * i]) + of_column(variance, columns[3 * i + 1]) +
             of_column(variance, columns[3 * i + 2]));
}

static void finish_pixel(const PixelMoments* pixel, __global const int* guide_columns, uint count, const RowOut* out,
                         int x) {
  const float samples = (float)count;
  __global float* cell = out->cells + x * out->cell_stride;
  __global float* statistics = cell + 2 * RPF_SAMPLE_FEATURES;
  finish_features(pixel, samples, cell);
  finish_color(&pixel->seen, samples, out, x, statistics);
  finish_guides(&pixel->records, guide_columns, samples, out, x, statistics);
}

// Values, guides and albedo of pixels.
__kernel void see(__global const float* records, __global const int* base_columns, __global const int* input_columns,
                  __global const float* weights1, __global const float* bias1, __global const float* weights2,
                  __global const float* bias2, __global const uint* first_sample, __global const int* guide_columns,
                  __global float* cells, __global float* guides, __global float* albedo, __global float* trace,
                  const rpf_samples l, const rpf_grid cell_grid, const rpf_grid guide_grid, const rpf_grid albedo_grid,
                  const int cell_stride) {
  const Seeing of = {records, base_columns, input_columns, weights1, bias1, weights2, bias2};
  RowOut out;
  out.cell_stride = cell_stride;
  out.guides_plane = plane_of(&guide_grid, RPF_GUIDES);
  out.albedo_plane = plane_of(&albedo_grid, RPF_ALBEDO_SUMS);
  Samples samples;
  PixelMoments pixel;
  for (int i = l.first_part + (int)get_global_id(0); i < l.end_part; i += (int)get_global_size(0)) {
    const Part part = part_of_launch(first_sample, &l, i);
    __global float* albedo_row = albedo + row_at(&albedo_grid, part.y);
    out.cells = cells + row_at(&cell_grid, part.y) + RPF_BORDER * cell_stride;
    out.guides = guides + row_at(&guide_grid, part.y) + RPF_MARGIN;
    out.albedo = albedo_row + RPF_MARGIN;
    close_planes(albedo_row, out.albedo_plane, RPF_ALBEDO_SUMS, part.begin, part.end, l.area.width, -0.0f);
    int x = part.begin;  // the first pixel that is not finished
    const uint end = first_of_pixel(&part, part.end);
    for (uint first = first_of_pixel(&part, x); first < end; first += RPF_SAMPLES_AT_ONCE) {
      see_samples(&of, &l, first, min(end - first, (uint)RPF_SAMPLES_AT_ONCE), &samples);
      if (l.is_traced) keep_samples(&samples, trace);
      for (uint s = 0; s < samples.count;) {
        const Stretch stretch = stretch_of(&part, x, &samples, s);
        for (; x < stretch.x; ++x) no_samples(&out, x);
        add_stretch(&of, &l, &samples, &stretch, &pixel);
        if (stretch.ends)
          finish_pixel(&pixel, guide_columns, first_of_pixel(&part, x + 1) - first_of_pixel(&part, x), &out, x);
        x += stretch.ends;
        s = stretch.to;
      }
    }
    for (; x < part.end; ++x) no_samples(&out, x);
  }
}
