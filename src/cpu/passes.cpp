#include "cpu/passes.h"

#include <algorithm>

#include "parallel/vectors.h"
#include "rpf_network.h"

namespace rpf {
namespace {

using kernel::fma;

/// The pixels of a row that have a neighbor dx to the right inside the frame.
struct Span {
  int begin, end;
};

Span span_of(int width, int dx) {
  return {std::min(std::max(-dx, 0), width), std::max(std::min(width - dx, width), 0)};
}

/// w_ij of the pixels of row y and their neighbors (dx, dy) away.
inline void weigh(const PassWeights& weights, int y, int dx, int dy, Span span, float* w) {
  if (dx == 0 && dy == 0) {
    std::copy_n(weights.own.at(y, 0), weights.own.width, w);
    return;
  }
  std::fill(w + span.begin, w + span.end, 0.0F);
  for (std::size_t k = 0; k < weights.embedding.channels; ++k) {
    const float *e = weights.embedding.at(y, k), *other = weights.embedding.at(y + dy, k) + dx;
    for (int x = span.begin; x < span.end; ++x) {
      const float t = e[x] - other[x];
      w[x] = fma(t, t, w[x]);
    }
  }
  for (int x = span.begin; x < span.end; ++x) w[x] = kernel::rpf_exp(-w[x]);
}

inline void add(const float* w, const Rows& in, int y, int dx, int dy, Span span, Rows& out, float* total) {
  for (int x = span.begin; x < span.end; ++x) total[x] += w[x];
  for (std::size_t c = 0; c < in.channels; ++c) {
    const float* value = in.at(y + dy, c) + dx;
    float* sum = out.at(y, c);
    for (int x = span.begin; x < span.end; ++x) sum[x] = fma(w[x], value[x], sum[x]);
  }
}

inline void filter_row_inside(const PassWeights& weights, int dilation, const Rows& in, int y, Rows& out) {
  std::vector<float> w(static_cast<std::size_t>(in.width)), total(w.size());
  std::fill_n(out.at(y, 0), out.channels * w.size(), 0.0F);
  for (int j = -RPF_PASS_REACH; j <= RPF_PASS_REACH; ++j)
    for (int i = -RPF_PASS_REACH; i <= RPF_PASS_REACH; ++i) {
      const int dx = i * dilation, dy = j * dilation;
      if (y + dy < 0 || y + dy >= in.height) continue;
      const Span span = span_of(in.width, dx);
      weigh(weights, y, dx, dy, span, w.data());
      add(w.data(), in, y, dx, dy, span, out, total.data());
    }
  for (float& t : total) t = 1.0F / t;
  for (std::size_t c = 0; c < out.channels; ++c)
    for (int x = 0; x < out.width; ++x) out.at(y, c)[x] *= total[static_cast<std::size_t>(x)];
}

}  // namespace

void filter_row(const PassWeights& weights, int dilation, const Rows& in, int y, Rows& out) {
  with_avx2([&] { filter_row_inside(weights, dilation, in, y, out); });
}

}  // namespace rpf
