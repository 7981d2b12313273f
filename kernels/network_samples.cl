// What the learned estimator sees of samples and of pixels, and the sums of a pixel's weighted samples.

// Where a pixel's samples lie.
typedef struct {
  size_t first;
  uint count;
} PixelSamples;

// Where first_sample says it of the chunk's first pixel; the others follow: a chunk of a part of a row has one row.
static int first_of_pixels(const rpf_chunk* c) {
  return (c->first / c->width - c->first_row) * c->frame_width + c->x + c->first % c->width;
}

static PixelSamples samples_of_pixel(__global const uint* first_sample, const rpf_chunk* c, int pixel) {
  __global const uint* first = first_sample + first_of_pixels(c) + (pixel - c->first);
  PixelSamples samples;
  samples.first = first[0] - c->first_sample;
  samples.count = first[1] - first[0];
  return samples;
}

// ---- samples --------------------------------------------------------------------------------------------------------

// A column of the records of RPF_LANES samples; 0 where there is none.
static float16 column_of(__global const float* records, const rpf_chunk* c, int column, uint first) {
  float values[RPF_LANES];
  if (column < 0) return 0.0f;
  for (uint l = 0; l < RPF_LANES; ++l)
    values[l] = records[(size_t)min(first + l, c->samples - 1) * (size_t)c->variables + (size_t)column];
  return vload16(0, values);
}

#ifdef RPF_AVX2  // Oclgrind does not know prefetches
// Asks for the records of RPF_LANES samples that are seen soon.
static void fetch_records(__global const float* records, const rpf_chunk* c, uint first) {
  const size_t end = (size_t)min(first + RPF_LANES, c->samples) * (size_t)c->variables;
  for (size_t i = (size_t)first * (size_t)c->variables; i < end; i += RPF_LANES)
    __builtin_prefetch((const void*)(size_t)(records + i));
}
#endif

// Samples of a row, or of what there is of it.
static uint first_of_row(int row) { return RPF_SAMPLE_ROW * (uint)row; }
static uint end_of_row(const rpf_chunk* c, int row) { return min(first_of_row(row + 1), c->samples); }

// What is computed of a row of samples. `base_columns`: of albedo and miss. Also writes behind the last sample, up to a
// multiple of RPF_LANES.
static void see_sample_row(__global const float* records, __global const int* base_columns, __global float* seen,
                           const rpf_chunk* c, int row) {
  for (uint s = first_of_row(row); s < end_of_row(c, row); s += RPF_LANES) {
#ifdef RPF_AVX2
    fetch_records(records, c, s + RPF_SAMPLE_ROW * (uint)get_global_size(0));
#endif
    const float16 miss = column_of(records, c, base_columns[3], s);
    float16 rows[RPF_LANES];
#pragma unroll
    for (int i = 0; i < 3; ++i) {
      const float16 color = rpf_seen_color(column_of(records, c, i, s), c->exposure);
      float16 base = 1.0f;
      if (c->has_albedo) base = rpf_albedo_base(column_of(records, c, base_columns[i], s), miss);
      rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS + i] = rpf_brightness(color);
      rows[RPF_SEEN_INPUTS + RPF_INPUT_BRIGHTNESS_OVER + i] = rpf_brightness_over(color, base);
      rows[RPF_SEEN_COLOR + i] = color;
      rows[RPF_SEEN_BASE + i] = base;
    }
    rows[RPF_SEEN_LUMINANCE] = rpf_luminance(rows[RPF_SEEN_COLOR], rows[RPF_SEEN_COLOR + 1], rows[RPF_SEEN_COLOR + 2]);
#pragma unroll
    for (int i = RPF_SEEN_BASE + 3; i < RPF_SEEN; ++i) rows[i] = 0.0f;
    transpose(rows);
#pragma unroll
    for (int l = 0; l < RPF_LANES; ++l) vstore16(rows[l], s + (uint)l, seen);
  }
}

// Layers over the samples of a row, generated behind this text (src/opencl/layer_blocking.cpp): from what is computed
// and columns of records to features, and from features with their context to what weight2 reads.
static void sample1(__global const float* computed, __global const float* records, __global const float* weights,
                    __global const float* bias, __global float* out, __global const int* columns, const rpf_layer l,
                    int row);
static void sample2(__global const float* coarse, __global const float* own, __global const float* weights,
                    __global const float* bias, __global float* out, const rpf_layer l, int row);
static void weight1(__global const float* coarse, __global const float* own, __global const float* weights,
                    __global const float* bias, __global float* out, const rpf_layer l, int row);

// What is computed of all samples, and their features; row by row, so that what a step writes is in the processor's
// first cache for the next.
__kernel void see_samples(__global const float* records, __global const int* base_columns, __global const int* columns,
                          __global const float* weights1, __global const float* bias1, __global const float* weights2,
                          __global const float* bias2, __global float* seen, __global float* hidden,
                          __global float* features, const rpf_chunk c, const rpf_layer first, const rpf_layer second) {
  for (int row = first_part(); row < end_part(&first.area); row += (int)get_global_size(0)) {
    see_sample_row(records, base_columns, seen, &c, row);
    sample1(seen, records, weights1, bias1, hidden, columns, first, row);
    sample2(hidden, hidden, weights2, bias2, features, second, row);
  }
}

// ---- pixels ---------------------------------------------------------------------------------------------------------

// Where a pixel's values go.
typedef struct {
  __global float *cell, *guides, *albedo;
  int guides_plane, albedo_plane;  // floats from one plane to the next
} PixelOut;

static void no_samples(const rpf_chunk* c, const PixelOut* out) {
  for (uint k = 0; k < rpf_pixel_values(c->features); ++k) out->cell[k] = 0.0f;
  for (int k = 0; k < RPF_GUIDES; ++k) out->guides[k * out->guides_plane] = 0.0f;
  for (int k = 0; k < RPF_ALBEDO_SUMS; ++k) out->albedo[k * out->albedo_plane] = 0.0f;
}

// Means and deviations of up to 8 features of a pixel's samples.
static void feature_moments(__global const float* features, const rpf_chunk* c, uint count, __global float* mean,
                            __global float* deviation, uint wanted) {
  const float8 first = vload8(0, features);
  float8 sum = 0.0f, squares = 0.0f;
  for (uint s = 1; s < count; ++s) {
    const float8 d = vload8(0, features + (size_t)s * c->stride) - first;
    sum += d;
    squares = fma(d, d, squares);
  }
  const float samples = (float)count;
  float means[8], deviations[8];
  vstore8(rpf_shifted_mean(first, sum, samples), 0, means);
  vstore8(rpf_feature_deviation(rpf_shifted_variance(sum, squares, samples)), 0, deviations);
  for (uint i = 0; i < wanted; ++i) {
    mean[i] = means[i];
    deviation[i] = deviations[i];
  }
}

// Statistics of the radiance, and the mean of a.
static void color_statistics(__global const float* seen, uint count, const PixelOut* out, __global float* statistics) {
  const float16 first = vload16(0, seen);
  float16 sum = 0.0f, squares = 0.0f;
  for (uint s = 1; s < count; ++s) {
    const float16 d = vload16(s, seen) - first;
    sum += d;
    squares = fma(d, d, squares);
  }
  const float samples = (float)count;
  float mean[RPF_SEEN], variance[RPF_SEEN], brightness[RPF_SEEN];
  const float16 means = rpf_shifted_mean(first, sum, samples);
  vstore16(means, 0, mean);
  vstore16(rpf_brightness(means), 0, brightness);
  vstore16(rpf_shifted_variance(sum, squares, samples), 0, variance);
  for (int i = 0; i < 3; ++i) {
    statistics[RPF_STATISTIC_BRIGHTNESS + i] = brightness[RPF_SEEN_COLOR + i];
    out->albedo[i * out->albedo_plane] = mean[RPF_SEEN_BASE + i];
  }
  out->albedo[3 * out->albedo_plane] = 1.0f;
  statistics[RPF_STATISTIC_ERROR] = rpf_relative_error(variance[RPF_SEEN_LUMINANCE], mean[RPF_SEEN_LUMINANCE], samples);
  statistics[RPF_STATISTIC_SAMPLES] = 1.0f / sqrt(samples);
}

// Means of the guides and their spreads, from the records of a pixel's samples.
static void guide_statistics(__global const float* record, __global const int* columns, const rpf_chunk* c, uint count,
                             const PixelOut* out, __global float* statistics) {
  const float samples = (float)count;
  float variance[RPF_GUIDES];
  for (int k = 0; k < RPF_GUIDES; ++k) {
    float first = 0.0f, sum = 0.0f, squares = 0.0f;
    if (columns[k] >= 0) {
      __global const float* value = record + columns[k];
      first = value[0];
      for (uint s = 1; s < count; ++s) {
        const float d = value[(size_t)s * (size_t)c->variables] - first;
        sum = rpf_added(sum, d);
        squares = fma(d, d, squares);
      }
    }
    const float mean = rpf_shifted_mean(first, sum, samples);
    variance[k] = rpf_shifted_variance(sum, squares, samples);
    statistics[RPF_STATISTIC_GUIDES + k] = mean;
    out->guides[k * out->guides_plane] = mean;
  }
  for (int i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_SPREADS + i] = sqrt(variance[3 * i] + variance[3 * i + 1] + variance[3 * i + 2]);
}

// Also of no planes, as a rehearsal (src/opencl) has them.
static int plane_of(const rpf_grid* grid, int planes) { return grid->pitch / max(planes, 1); }

// Beside the planes of a row stands what adds nothing to a sum, whatever its weight: fma(0, -0, s) is s.
static void close_planes(__global float* row, int plane, int planes, int begin, int end, int width, float beside) {
  for (int k = 0; k < planes; ++k) {
    for (int x = 0; begin == 0 && x < RPF_MARGIN; ++x) row[k * plane + x] = beside;
    for (int x = RPF_MARGIN + width; end == width && x < plane; ++x) row[k * plane + x] = beside;
  }
}

// `guide_columns`: -1 for a guide that is 0.
__kernel void see_pixels(__global const float* records, __global const int* guide_columns, __global const float* seen,
                         __global const float* features, __global const uint* first_sample, __global float* cells,
                         __global float* guides, __global float* albedo, const rpf_chunk c, const rpf_grid cell_grid,
                         const rpf_grid guide_grid, const rpf_grid albedo_grid, const int cell_stride) {
  PixelOut out;
  out.guides_plane = plane_of(&guide_grid, RPF_GUIDES);
  out.albedo_plane = plane_of(&albedo_grid, RPF_ALBEDO_SUMS);
  for (int p = c.first + (int)get_global_id(0); p < c.end; p += (int)get_global_size(0)) {
    const int y = p / c.width, x = p % c.width;
    const PixelSamples samples = samples_of_pixel(first_sample, &c, p);
    out.cell = cells + row_at(&cell_grid, y) + (x + RPF_BORDER) * cell_stride;
    out.guides = guides + row_at(&guide_grid, y) + RPF_MARGIN + x;
    __global float* albedo_row = albedo + row_at(&albedo_grid, y);
    out.albedo = albedo_row + RPF_MARGIN + x;
    close_planes(albedo_row, out.albedo_plane, RPF_ALBEDO_SUMS, x, x + 1, c.width, -0.0f);
    if (samples.count == 0) {
      no_samples(&c, &out);
      continue;
    }
    for (uint k = 0; k < c.features; k += 8)
      feature_moments(features + samples.first * c.stride + k, &c, samples.count, out.cell + k,
                      out.cell + c.features + k, min(c.features - k, 8u));
    __global float* statistics = out.cell + 2 * c.features;
    color_statistics(seen + samples.first * RPF_SEEN, samples.count, &out, statistics);
    guide_statistics(records + samples.first * (size_t)c.variables, guide_columns, &c, samples.count, &out, statistics);
  }
}

// ---- weights and sums -----------------------------------------------------------------------------------------------

// The last of some pixels that begins with this sample or before. `first`: where their samples begin; there is one
// more.
static int pixel_of_sample(__global const uint* first, int pixels, uint sample) {
  int low = 0, high = pixels;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (first[middle] <= sample)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// Puts the context of its pixel behind the features of every sample of a row.
static void add_context(__global const float* heads, __global const uint* first_sample, __global float* features,
                        const rpf_chunk* c, const rpf_grid* head_grid, int head_stride, int row) {
  const uint end = end_of_row(c, row);
  __global const uint* first = first_sample + first_of_pixels(c);
  int pixel = pixel_of_sample(first, c->end - c->first, c->first_sample + first_of_row(row));
  for (uint s = first_of_row(row); s < end; ++pixel) {
    const int y = (c->first + pixel) / c->width, x = (c->first + pixel) % c->width;
    const float8 context = vload8(0, heads + row_at(head_grid, y) + (x + RPF_BORDER) * head_stride);
    const uint end_of_pixel = min(first[pixel + 1] - c->first_sample, end);
    for (; s < end_of_pixel; ++s) vstore8(context, 0, features + (size_t)s * c->stride + c->features);
  }
}

// weight2 and what follows, of a row of samples. `hidden`: [sample][RPF_WEIGHT_FEATURES] of weight1; `output`: as many
// weights and the bias. Also writes behind the last sample, up to a multiple of RPF_LANES.
static void weigh_sample_row(__global const float* hidden, __global const float* output,
                             __global const float* file_weights, __global float* weights, const rpf_chunk* c, int row) {
  for (uint s = first_of_row(row); s < end_of_row(c, row); s += RPF_LANES) {
    float16 rows[RPF_LANES];
#pragma unroll
    for (int l = 0; l < RPF_LANES; ++l) rows[l] = vload16(s + (uint)l, hidden);
    transpose(rows);
    float16 logit = output[RPF_WEIGHT_FEATURES];
#pragma unroll
    for (int k = 0; k < RPF_WEIGHT_FEATURES; ++k) logit = fma(rows[k], output[k], logit);
    vstore16(rpf_learned_weight(logit), 0, weights + s);
    for (uint l = s; c->has_weights && l < min(s + RPF_LANES, c->samples); ++l)
      weights[l] = weights[l] * (file_weights[l] * c->weight_scale);
  }
}

// Weights of all samples, from what the head says of their pixels; what comes before is computed once more.
__kernel void weigh_samples(__global const float* records, __global const int* base_columns,
                            __global const int* columns, __global const float* weights1, __global const float* bias1,
                            __global const float* weights2, __global const float* bias2, __global float* seen,
                            __global float* hidden, __global float* features, const rpf_chunk c, const rpf_layer first,
                            const rpf_layer second, __global const float* heads, __global const uint* first_sample,
                            __global const float* hidden_weights, __global const float* hidden_bias,
                            __global const float* output, __global const float* file_weights, __global float* weighed,
                            __global float* weights, const rpf_layer third, const rpf_grid head_grid,
                            const int head_stride) {
  for (int row = first_part(); row < end_part(&first.area); row += (int)get_global_size(0)) {
    see_sample_row(records, base_columns, seen, &c, row);
    sample1(seen, records, weights1, bias1, hidden, columns, first, row);
    sample2(hidden, hidden, weights2, bias2, features, second, row);
    add_context(heads, first_sample, features, &c, &head_grid, head_stride, row);
    weight1(features, features, hidden_weights, hidden_bias, weighed, third, row);
    weigh_sample_row(weighed, output, file_weights, weights, &c, row);
  }
}

// Of values that lie `stride` apart.
static float weighted_sum(__global const float* weights, __global const float* values, int stride, uint count) {
  float sum = 0.0f;
  for (uint s = 0; s < count; ++s) sum = fma(weights[s], values[(size_t)s * (size_t)stride], sum);
  return sum;
}

// `others`: what is carried beside the color; whatever where there is nothing.
__kernel void sum_samples(__global const float* weights, __global const float* seen, __global const float* records,
                          __global const float* others, __global const uint* first_sample, __global float* sums,
                          const rpf_chunk c, const rpf_grid grid) {
  const int planes = (int)rpf_sums((uint)c.carried), plane = plane_of(&grid, planes);
  for (int p = c.first + (int)get_global_id(0); p < c.end; p += (int)get_global_size(0)) {
    const int y = p / c.width, x = p % c.width;
    const PixelSamples samples = samples_of_pixel(first_sample, &c, p);
    __global const float* color = records + samples.first * (size_t)c.variables;
    __global const float* other = others + samples.first * (size_t)(c.carried - 3);
    __global const float* base = seen + samples.first * RPF_SEEN + RPF_SEEN_BASE;
    __global float* row = sums + row_at(&grid, y);
    __global float* out = row + RPF_MARGIN + x;
    for (int k = 0; k < 3; ++k)
      out[(RPF_SUM_RADIANCE + k) * plane] =
          weighted_sum(weights + samples.first, color + k, c.variables, samples.count);
    for (int k = 0; k + 3 < c.carried; ++k)
      out[(RPF_SUM_OTHERS + k) * plane] =
          weighted_sum(weights + samples.first, other + k, c.carried - 3, samples.count);
    for (int k = 0; k < 3; ++k)
      out[(RPF_SUM_BASE + k) * plane] = weighted_sum(weights + samples.first, base + k, RPF_SEEN, samples.count);
    float total = 0.0f;
    for (uint s = 0; s < samples.count; ++s) total = rpf_added(total, weights[samples.first + s]);
    out[RPF_SUM_WEIGHT * plane] = total;
    close_planes(row, plane, planes, x, x + 1, c.width, -0.0f);
  }
}
