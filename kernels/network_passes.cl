// The passes of the learned estimator and its result, for RPF_LANES pixels of a row at once.

#define RPF_TAPS 5           // in a row
#define RPF_NOT_THERE 1e30f  // an embedding value whose distance to any other is infinite
#define RPF_PLACES(x) (RPF_MARGIN + (x))

// Stores RPF_LANES pixels of an output of the head as what a pass weighs with: planes of embedding values, then of the
// guides' products, then w_ii.
static void store_weight(float16 logit, int value, int embedding, __global const float* guide, int guide_plane,
                         __global float* out, int plane) {
  const int g = value - embedding - 1;
  if (g < 0)
    vstore16(value < embedding ? rpf_embedding(logit) : rpf_own_weight(logit), 0,
             out + (value < embedding ? value : embedding + RPF_GUIDES) * plane);
  else
    vstore16(rpf_bandwidth(logit) * vload16(0, guide + g * guide_plane), 0, out + (value - 1) * plane);
}

// A pass's outputs of the head for RPF_LANES cells, generated behind this text (src/opencl/layer_blocking.cpp):
// out[RPF_PASS_VALUES][cell] from in[RPF_HEAD_INPUTS][cell].
static void head_of_pass(const float* in, __global const float* weights, __global const float* bias, float* out);

// Columns of RPF_LANES cells from x on, of which `last` is the last; that one once more in the place of those behind.
static void load_cells(__global const float* cells, int stride, int x, int last, float* columns) {
  for (int first = 0; first < RPF_HEAD_INPUTS; first += RPF_LANES) {
    float16 rows[RPF_LANES];
#pragma unroll
    for (int l = 0; l < RPF_LANES; ++l) rows[l] = vload16(0, cells + min(x + l, last) * stride + first);
    transpose(rows);
#pragma unroll
    for (int k = 0; k < RPF_LANES; ++k)
      if (first + k < RPF_HEAD_INPUTS) vstore16(rows[k], first + k, columns);
  }
}

// What a pass weighs with. `cells`: of the last layer; `weights`, `bias`: of the head's outputs for this pass;
// `logits`: planes of these outputs, where somebody wants them (its grid has rows then).
__kernel void embed(__global const float* cells, __global const float* guides, __global const float* weights,
                    __global const float* bias, __global float* out, __global float* logits, const rpf_area area,
                    const rpf_grid cell_grid, const rpf_grid guide_grid, const rpf_grid grid, const rpf_grid logit_grid,
                    const int cell_stride, const int embedding) {
  const int plane = plane_of(&grid, embedding + RPF_GUIDES + 1), guide_plane = plane_of(&guide_grid, RPF_GUIDES);
  const int logit_plane = plane_of(&logit_grid, RPF_PASS_VALUES);
  for (int i = first_part(&area), last = end_part(&area); i < last; ++i) {
    const int y = row_of_part(&area, i), begin = begin_of_part(&area, i), end = end_of_part(&area, i);
    __global const float* line = cells + row_at(&cell_grid, y) + RPF_BORDER * cell_stride;
    __global const float* guide = guides + row_at(&guide_grid, y) + RPF_MARGIN;
    __global float* row = out + row_at(&grid, y);
    for (int x = begin; x < end; x += RPF_LANES) {
      float inputs[RPF_HEAD_INPUTS * RPF_LANES], values[RPF_PASS_VALUES * RPF_LANES];
      load_cells(line, cell_stride, x, area.width - 1, inputs);
      head_of_pass(inputs, weights, bias, values);
      for (int k = 0; k < RPF_PASS_VALUES; ++k) {
        const float16 value = vload16(k, values);
        store_weight(value, k, embedding, guide + x, guide_plane, row + RPF_PLACES(x), plane);
        if (logit_grid.rows > 0) vstore16(value, 0, logits + row_at(&logit_grid, y) + k * logit_plane + RPF_PLACES(x));
      }
    }
    for (int x = 0; begin == 0 && x < RPF_MARGIN; ++x) row[x] = RPF_NOT_THERE;
    for (int x = RPF_PLACES(area.width); end == area.width && x < plane; ++x) row[x] = RPF_NOT_THERE;
  }
}

// Squared distances of RPF_LANES pixels from `own` on to those at five places of a row, then the weights.
static void weigh_row(__global const float* own, __global const float* other, int terms, int plane, int dilation,
                      __global float* weights, int weight_plane) {
  float16 d0 = 0.0f, d1 = 0.0f, d2 = 0.0f, d3 = 0.0f, d4 = 0.0f;
  for (int k = 0; k < terms; ++k) {
    __global const float* o = other + k * plane;
    const float16 e = vload16(0, own + k * plane);
    ask_for(o + RPF_PASS_REACH * dilation + 2 * RPF_LANES);  // the last that the next pixels read
    const float16 t0 = e - vload16(0, o - 2 * dilation), t1 = e - vload16(0, o - dilation), t2 = e - vload16(0, o),
                  t3 = e - vload16(0, o + dilation), t4 = e - vload16(0, o + 2 * dilation);
    d0 = fma(t0, t0, d0);
    d1 = fma(t1, t1, d1);
    d2 = fma(t2, t2, d2);
    d3 = fma(t3, t3, d3);
    d4 = fma(t4, t4, d4);
  }
  vstore16(rpf_exp(-d0), 0, weights);
  vstore16(rpf_exp(-d1), 0, weights + weight_plane);
  vstore16(rpf_exp(-d2), 0, weights + 2 * weight_plane);
  vstore16(rpf_exp(-d3), 0, weights + 3 * weight_plane);
  vstore16(rpf_exp(-d4), 0, weights + 4 * weight_plane);
}

// The same for the two places further on in the pixels' own row.
static void weigh_own_row(__global const float* own, int terms, int plane, int dilation, __global float* weights,
                          int weight_plane) {
  float16 d3 = 0.0f, d4 = 0.0f;
  for (int k = 0; k < terms; ++k) {
    __global const float* o = own + k * plane;
    const float16 e = vload16(0, o);
    const float16 t3 = e - vload16(0, o + dilation), t4 = e - vload16(0, o + 2 * dilation);
    d3 = fma(t3, t3, d3);
    d4 = fma(t4, t4, d4);
  }
  vstore16(rpf_exp(-d3), 0, weights);
  vstore16(rpf_exp(-d4), 0, weights + weight_plane);
}

// Planes of the weights of RPF_PASS_PAIRS pairs: of a pixel with those at +1 and +2 (times the dilation) in its row,
// then with those at -2 .. +2 in the two rows below; then w_ii.
__kernel void weigh_pixels(__global const float* embedded, __global float* weights, const rpf_area area,
                           const rpf_grid embedded_grid, const rpf_grid grid, const int dilation, const int terms) {
  const int plane = plane_of(&embedded_grid, terms + 1), weight_plane = plane_of(&grid, RPF_PASS_PAIRS + 1);
  for (int i = first_part(&area), last = end_part(&area); i < last; ++i) {
    const int y = row_of_part(&area, i), begin = begin_of_part(&area, i), end = end_of_part(&area, i);
    __global float* row = weights + row_at(&grid, y);
    for (int x = begin; x < end; x += RPF_LANES) {
      __global const float* own = embedded + row_at(&embedded_grid, y) + RPF_PLACES(x);
      __global float* to = row + RPF_PLACES(x);
      weigh_own_row(own, terms, plane, dilation, to, weight_plane);
      for (int j = 1; j <= RPF_PASS_REACH && y + j * dilation < area.height; ++j)
        weigh_row(own, embedded + row_at(&embedded_grid, y + j * dilation) + RPF_PLACES(x), terms, plane, dilation,
                  to + (RPF_TAPS * j - 3) * weight_plane, weight_plane);
      vstore16(vload16(0, own + terms * plane), 0, to + RPF_PASS_PAIRS * weight_plane);
    }
    close_planes(row, weight_plane, RPF_PASS_PAIRS + 1, begin, end, area.width, 0.0f);
  }
}

// What a pass reads for RPF_LANES pixels of row y: weights, values and how far their planes lie apart.
typedef struct {
  __global const float *weights, *in;  // row 0, at the pixels
  int y, plane, in_plane;
} PassInput;

// Weight of the pixels with those at tap t of row j. `own`, `other`: what weigh_pixels() made of them and of those
// right above.
static float16 weight_at(__global const float* own, __global const float* other, int j, int t, int plane,
                         int dilation) {
  const int right = t - RPF_PASS_REACH, from = (j - RPF_PASS_REACH) * RPF_TAPS + right;  // 1, 2, 3 .. 12 further on
  return vload16(0, from > 0   ? own + (from - 1) * plane
                    : from < 0 ? other + (-from - 1) * plane + right * dilation
                               : own + RPF_PASS_PAIRS * plane);
}

// Means of the planes first .. first + count - 1, side by side so that multiply-adds do not wait for each other.
// `count` is known when this is compiled.
__attribute__((always_inline)) static void filter_planes(const PassInput* from, const rpf_network_pass* p, int first,
                                                         const int count, __global float* out) {
  __global const float* own = from->weights + row_at(&p->weights, from->y);
  float16 total = 0.0f, sums[RPF_SUM_OTHERS];
#pragma unroll
  for (int k = 0; k < count; ++k) sums[k] = 0.0f;
#pragma nounroll  // it would take seconds to compile
  for (int j = 0; j < RPF_TAPS; ++j) {
    const int row = from->y + (j - RPF_PASS_REACH) * p->dilation;
    if (row < 0 || row >= p->area.height) continue;
    __global const float* other = from->weights + row_at(&p->weights, min(row, from->y));
    __global const float* values = from->in + row_at(&p->in, row) + first * from->in_plane;
#pragma unroll
    for (int t = 0; t < RPF_TAPS; ++t) {
      const float16 w = weight_at(own, other, j, t, from->plane, p->dilation);
      total += w;
#pragma unroll
      for (int k = 0; k < count; ++k)
        sums[k] = fma(w, vload16(0, values + k * from->in_plane + (t - RPF_PASS_REACH) * p->dilation), sums[k]);
    }
  }
  const float16 inverse = 1.0f / total;
#pragma unroll
  for (int k = 0; k < count; ++k) vstore16(sums[k] * inverse, 0, out + (first + k) * from->in_plane);
}

__kernel void filter_pass(__global const float* weights, __global const float* in, __global float* out,
                          const rpf_network_pass p) {
  PassInput from;
  from.plane = plane_of(&p.weights, RPF_PASS_PAIRS + 1);
  from.in_plane = plane_of(&p.in, p.values);
  for (int i = first_part(&p.area), last = end_part(&p.area); i < last; ++i) {
    const int begin = begin_of_part(&p.area, i), end = end_of_part(&p.area, i);
    from.y = row_of_part(&p.area, i);
    __global float* result = out + row_at(&p.out, from.y);
    for (int x = begin; x < end; x += RPF_LANES) {
      from.weights = weights + RPF_PLACES(x);
      from.in = in + RPF_PLACES(x);
      __global float* to = result + RPF_PLACES(x);
      int k = 0;
      for (; k + RPF_SUM_OTHERS <= p.values; k += RPF_SUM_OTHERS) filter_planes(&from, &p, k, RPF_SUM_OTHERS, to);
      for (; k + RPF_ALBEDO_SUMS <= p.values; k += RPF_ALBEDO_SUMS) filter_planes(&from, &p, k, RPF_ALBEDO_SUMS, to);
      for (; k < p.values; ++k) filter_planes(&from, &p, k, 1, to);
    }
    close_planes(result, from.in_plane, p.values, begin, end, p.area.width, -0.0f);
  }
}

// The picture: pixels [row][column][carried] of a region. `sums` and `albedo` after their passes, `heads`: the first
// outputs of the head.
__kernel void finish(__global const float* sums, __global const float* albedo, __global const float* heads,
                     __global float* out, const rpf_area area, const rpf_grid sum_grid, const rpf_grid albedo_grid,
                     const rpf_grid head_grid, const rpf_region region, const int head_stride, const int carried,
                     const int has_albedo) {
  const int plane = plane_of(&sum_grid, (int)rpf_sums((uint)carried));
  const int albedo_plane = plane_of(&albedo_grid, RPF_ALBEDO_SUMS);
  for (int i = first_part(&area), last = end_part(&area); i < last; ++i) {
    const int y = row_of_part(&area, i), begin = begin_of_part(&area, i), end = end_of_part(&area, i);
    __global const float* blends = heads + row_at(&head_grid, y) + RPF_BORDER * head_stride + RPF_HEAD_BLEND;
    __global float* row = out + (size_t)(y - region.y) * (size_t)region.width * (size_t)carried;
    for (int x = begin; x < end; x += RPF_LANES) {
      __global const float* sum = sums + row_at(&sum_grid, y) + RPF_PLACES(x);
      __global const float* base = albedo + row_at(&albedo_grid, y) + RPF_PLACES(x);
      float values[RPF_LANES];
      for (int l = 0; l < RPF_LANES; ++l) values[l] = blends[min(x + l, area.width - 1) * head_stride];
      const float16 blend = rpf_blend(vload16(0, values)), weight = vload16(0, sum + RPF_SUM_WEIGHT * plane),
                    covered = vload16(0, base + 3 * albedo_plane);
      const int first = max(x, region.x), last = min(min(x + RPF_LANES, end), region.x + region.width) - 1;
      for (int k = 0; k < carried; ++k) {
        const int from = k < 3 ? RPF_SUM_RADIANCE + k : RPF_SUM_OTHERS + k - 3;
        const float16 carried_sum = vload16(0, sum + from * plane);
        float16 value = rpf_over_weight(carried_sum, weight);
        if (has_albedo && k < 3)
          value = rpf_blended(value, carried_sum, vload16(0, sum + (RPF_SUM_BASE + k) * plane),
                              vload16(0, base + k * albedo_plane), covered, blend);
        vstore16(value, 0, values);
        for (int p = first; p <= last; ++p) row[(p - region.x) * carried + k] = values[p - x];
      }
    }
  }
}
