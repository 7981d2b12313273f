// Weights of samples in the learned estimator, and the sums of pixels.

// The sums of a pixel's weighted samples: of what stands in RPF_SEEN from RPF_SEEN_SUMMED on.
typedef struct {
  float8 seen;
  float weight;
} PixelSums;

static PixelSums no_sums(void) {
  PixelSums sums;
  sums.seen = 0.0f;
  sums.weight = 0.0f;
  return sums;
}

static void add_weighted(const Samples* samples, const Stretch* stretch, const float* weights, PixelSums* pixel) {
  PixelSums sums = stretch->begins ? no_sums() : *pixel;
  for (uint s = stretch->from; s < stretch->to; ++s) {
    const float weight = weights[s];
    sums.seen = fma((float8)weight, vload8(0, samples->seen + s * RPF_SEEN + RPF_SEEN_SUMMED), sums.seen);
    sums.weight = rpf_added(sums.weight, weight);
  }
  *pixel = sums;
}

// Of what is carried beside the color: straight into its planes.
static void add_weighted_others(__global const float* others, const rpf_samples* l, const Samples* samples,
                                const Stretch* stretch, const float* weights, __global float* sums, int plane) {
  const int count = l->carried - 3;
  for (int k = 0; k < count; ++k) {
    __global float* out = sums + (RPF_SUM_OTHERS + k) * plane + stretch->x;
    float sum = stretch->begins ? 0.0f : *out;
    for (uint s = stretch->from; s < stretch->to; ++s)
      sum = fma(weights[s], others[(size_t)(samples->first + s) * (size_t)count + (size_t)k], sum);
    *out = sum;
  }
}

static void finish_sums(const PixelSums* pixel, __global float* sums, int plane, int x) {
  float seen[RPF_SEEN];
  vstore8(pixel->seen, 0, seen + RPF_SEEN_SUMMED);
  for (int k = 0; k < 3; ++k) {
    sums[(RPF_SUM_RADIANCE + k) * plane + x] = seen[RPF_SEEN_RADIANCE + k];
    sums[(RPF_SUM_BASE + k) * plane + x] = seen[RPF_SEEN_BASE + k];
  }
  sums[RPF_SUM_WEIGHT * plane + x] = pixel->weight;
}

static void no_weighted_samples(__global float* sums, int planes, int plane, int x) {
  for (int k = 0; k < planes; ++k) sums[k * plane + x] = 0.0f;
}

// Puts the context of its pixel behind the features of every sample.
static void add_context(const Part* part, int x, __global const float* heads, int head_stride, Samples* samples) {
  for (uint s = 0; s < samples->count;) {
    const Stretch stretch = stretch_of(part, x, samples, s);
    x = stretch.x;
    const float8 context = vload8(0, heads + x * head_stride);
    for (; s < stretch.to; ++s) vstore8(context, 0, samples->features + s * RPF_FEATURE_STRIDE + RPF_SAMPLE_FEATURES);
  }
}

// weight2 and what follows. `hidden`: [sample][RPF_WEIGHT_FEATURES] of weight1; `output`: as many weights and the bias;
// `file_weights`: of the samples of the launch.
static void weigh_samples(const float* hidden, __global const float* output, __global const float* file_weights,
                          const rpf_samples* l, const Samples* samples, float* weights) {
  for (uint s = 0; s < samples->count; s += RPF_LANES) {
    float16 rows[RPF_LANES];
#pragma unroll
    for (uint i = 0; i < RPF_LANES; ++i) rows[i] = vload16(s + i, hidden);
    transpose(rows);
    float16 logit = output[RPF_WEIGHT_FEATURES];
#pragma unroll
    for (int k = 0; k < RPF_WEIGHT_FEATURES; ++k) logit = fma(rows[k], output[k], logit);
    vstore16(rpf_learned_weight(logit), 0, weights + s);
  }
  for (uint s = 0; l->has_weights && s < samples->count; ++s)
    weights[s] = weights[s] * (file_weights[samples->first + s] * l->weight_scale);
}

// Sums of the pixels' weighted samples, from what the head says of them and from what was kept; where there was no room
// (a grid without rows) what comes before is computed once more. `others`: what is carried beside the color; whatever
// where there is nothing.
__kernel void sum(__global const float* records, __global const int* base_columns, __global const int* input_columns,
                  __global const float* weights1, __global const float* bias1, __global const float* weights2,
                  __global const float* bias2, __global const uint* first_sample, __global const float* heads,
                  __global const float* hidden_weights, __global const float* hidden_bias, __global const float* output,
                  __global const float* file_weights, __global const float* others, __global const float* kept,
                  __global float* sums, __global float* trace, const rpf_samples l, const rpf_grid head_grid,
                  const rpf_grid kept_grid, const rpf_grid grid, const int head_stride) {
  const Seeing of = {records, base_columns, input_columns, weights1, bias1, weights2, bias2};
  const int planes = (int)rpf_sums((uint)l.carried), plane = plane_of(&grid, planes);
  Samples samples;
  PixelSums pixel;
  float hidden[RPF_SAMPLES_AT_ONCE * RPF_WEIGHT_FEATURES], weights[RPF_SAMPLES_AT_ONCE];
  const int parts = l.end_part - l.first_part, end_of_share = l.first_part + share_of(parts, get_global_id(0) + 1);
  for (int i = l.first_part + share_of(parts, get_global_id(0)); i < end_of_share; ++i) {
    const Part part = part_of_launch(first_sample, &l, i);
    __global const float* head_row = heads + row_at(&head_grid, part.y) + RPF_BORDER * head_stride;
    __global float* row = sums + row_at(&grid, part.y);
    __global float* out = row + RPF_MARGIN;
    close_planes(row, plane, planes, part.begin, part.end, l.area.width, -0.0f);
    int x = part.begin;  // the first pixel that is not finished
    const uint end = first_of_pixel(&part, part.end);
    for (uint first = first_of_pixel(&part, x); first < end; first += RPF_SAMPLES_AT_ONCE) {
      const uint count = min(end - first, (uint)RPF_SAMPLES_AT_ONCE);
      if (kept_grid.rows > 0)
        kept_samples(kept + kept_at(&kept_grid, &part, first), first, count, &samples);
      else
        see_samples(&of, &l, first, count, &samples);
      add_context(&part, x, head_row, head_stride, &samples);
      weight1(samples.features, hidden_weights, hidden_bias, hidden, (int)samples.count);
      weigh_samples(hidden, output, file_weights, &l, &samples, weights);
      for (uint s = 0; l.is_traced && s < samples.count; ++s) trace[first + s] = weights[s];
      for (uint s = 0; s < samples.count;) {
        const Stretch stretch = stretch_of(&part, x, &samples, s);
        for (; x < stretch.x; ++x) no_weighted_samples(out, planes, plane, x);
        add_weighted(&samples, &stretch, weights, &pixel);
        add_weighted_others(others, &l, &samples, &stretch, weights, out, plane);
        if (stretch.ends) finish_sums(&pixel, out, plane, x);
        x += stretch.ends;
        s = stretch.to;
      }
    }
    for (; x < part.end; ++x) no_weighted_samples(out, planes, plane, x);
  }
}
