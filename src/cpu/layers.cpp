#include "cpu/layers.h"

#include <algorithm>

#include "parallel/vectors.h"
#include "rpf_network.h"

namespace rpf {
namespace {

/// Sums side by side in one vector register, where there is one.
constexpr int lanes = 8;

inline void add_products(float x, const float* weights, float* sums) {
  for (int o = 0; o < lanes; ++o) sums[o] = kernel::fma(x, weights[o], sums[o]);
}

/// Blocks * lanes sums, from `first` on, of each of some cells at once. Both numbers are known to the compiler, so that
/// all sums stay in registers.
template <int Cells, int Blocks>
inline void accumulate_block(const float* const* x, int inputs, const float* weights, int stride, int first,
                             float* const* acc) {
  float sums[Cells][Blocks][lanes];
  for (int c = 0; c < Cells; ++c) std::copy_n(acc[c] + first, Blocks * lanes, &sums[c][0][0]);
  for (int i = 0; i < inputs; ++i)
#pragma GCC unroll 4
    for (int c = 0; c < Cells; ++c)
#pragma GCC unroll 4
      for (int b = 0; b < Blocks; ++b) add_products(x[c][i], weights + i * stride + first + b * lanes, sums[c][b]);
  for (int c = 0; c < Cells; ++c) std::copy_n(&sums[c][0][0], Blocks * lanes, acc[c] + first);
}

/// acc[c][o] = fma(x[c][i], weights[i][o], acc[c][o]) for every input in turn; `stride`: outputs of the whole layer.
template <int Cells>
inline void accumulate(const float* const* x, int inputs, const float* weights, int stride, int outputs,
                       float* const* acc) {
  constexpr int wide = Cells == 1 ? 4 : 2;  // blocks: as many as registers hold
  int o = 0;
  for (; o + wide * lanes <= outputs; o += wide * lanes)
    accumulate_block<Cells, wide>(x, inputs, weights, stride, o, acc);
  for (; o + lanes <= outputs; o += lanes) accumulate_block<Cells, 1>(x, inputs, weights, stride, o, acc);
  for (; o < outputs; ++o)
    for (int c = 0; c < Cells; ++c)
      for (int i = 0; i < inputs; ++i) acc[c][o] = kernel::fma(x[c][i], weights[i * stride + o], acc[c][o]);
}

/// Cells x .. x + Cells - 1 of a row.
template <int Cells>
inline void convolve_cells(const NetworkLayer& layer, const std::vector<Source>& sources, int x, int y, Field& out) {
  float* acc[Cells];
  for (int c = 0; c < Cells; ++c) {
    acc[c] = out.at(x + c, y);
    std::copy(layer.bias.begin(), layer.bias.end(), acc[c]);
  }
  const float* weights = layer.weights.data();
  for (int ky = -1; ky <= 1; ++ky)
    for (int kx = -1; kx <= 1; ++kx)
      for (const Source& s : sources) {
        const int inputs = static_cast<int>(s.field->channels), from_y = std::clamp(y + ky, 0, out.height - 1);
        const float* from[Cells];
        for (int c = 0; c < Cells; ++c)
          from[c] = s.field->at(std::clamp(x + c + kx, 0, out.width - 1) >> s.halvings, from_y >> s.halvings);
        accumulate<Cells>(from, inputs, weights, layer.outputs, layer.outputs, acc);
        weights += static_cast<std::size_t>(inputs) * static_cast<std::size_t>(layer.outputs);
      }
  for (float* a : acc) activate(a, layer.outputs);
}

}  // namespace

void dense(const NetworkLayer& layer, const float* x, int first, int count, float* out) {
  with_avx2([&] {
    std::copy_n(layer.bias.begin() + first, count, out);
    accumulate<1>(&x, layer.inputs, layer.weights.data() + first, layer.outputs, count, &out);
  });
}

void activate(float* values, int count) {
  for (int i = 0; i < count; ++i) values[i] = kernel::rpf_leaky(values[i]);
}

void convolve_row(const NetworkLayer& layer, const std::vector<Source>& sources, int y, Field& out) {
  with_avx2([&] {
    int x = 0;
    for (; x + 4 <= out.width; x += 4) convolve_cells<4>(layer, sources, x, y, out);
    for (; x < out.width; ++x) convolve_cells<1>(layer, sources, x, y, out);
  });
}

void halve_row(const Field& in, int y, Field& out) {
  const int rows = std::min(in.height - 2 * y, 2);
  for (int x = 0; x < out.width; ++x) {
    const int columns = std::min(in.width - 2 * x, 2);
    const float share = 1.0F / static_cast<float>(rows * columns);
    for (std::size_t c = 0; c < in.channels; ++c) {
      float sum = 0;
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) sum += in.at(2 * x + i, 2 * y + j)[c];
      out.at(x, y)[c] = sum * share;
    }
  }
}

}  // namespace rpf
