// One pass of docs/network.md, "Sums", with its derivative, for PyTorch: the 25 taps as one operation. Composed of PyTorch's
// own operations a pass costs some ten times as much, for each would write 25 copies of the planes.
//
// Planes are [channel][y][x], float. Weights of a pair are symmetric (w_ij = w_ji); a pixel's own weight is not.
#include <torch/extension.h>

#include <cmath>
#include <vector>

namespace {

constexpr int radius = 2;

struct Planes {
  const float* data;
  int64_t channels, height, width;
  const float* row(int64_t c, int64_t y) const { return data + (c * height + y) * width; }
};

Planes planes(const torch::Tensor& t) { return {t.data_ptr<float>(), t.size(0), t.size(1), t.size(2)}; }

/// Calls work(dy, dx, first, last) for every tap but the pixel itself that lies in the frame for row y, with the range of x.
template <typename Work>
void for_taps(int64_t y, int64_t height, int64_t width, int64_t dilation, Work work) {
  for (int64_t j = -radius; j <= radius; ++j)
    for (int64_t i = -radius; i <= radius; ++i) {
      const int64_t dy = j * dilation, dx = i * dilation;
      if ((i == 0 && j == 0) || y + dy < 0 || y + dy >= height) continue;
      const int64_t first = std::max<int64_t>(0, -dx), last = std::min(width, width - dx);
      if (first < last) work(dy, dx, first, last);
    }
}

/// w[x] = exp(-|e(x, y) - e(x + dx, y + dy)|^2)
void pair_weights(const Planes& e, int64_t y, int64_t dy, int64_t dx, int64_t first, int64_t last, float* w) {
  for (int64_t x = first; x < last; ++x) w[x] = 0;
  for (int64_t k = 0; k < e.channels; ++k) {
    const float *here = e.row(k, y), *there = e.row(k, y + dy) + dx;
    for (int64_t x = first; x < last; ++x) w[x] += (here[x] - there[x]) * (here[x] - there[x]);
  }
  for (int64_t x = first; x < last; ++x) w[x] = std::exp(-std::min(w[x], 80.0f));
}

/// -> weighted means [values], sum of the weights
std::vector<torch::Tensor> forward(torch::Tensor embedding, torch::Tensor own, torch::Tensor values, int64_t dilation) {
  torch::Tensor means = torch::empty_like(values), total = torch::empty_like(own);
  const Planes e = planes(embedding), v = planes(values);
  const float* own_weight = own.data_ptr<float>();
  float *out = means.data_ptr<float>(), *sums = total.data_ptr<float>();
  at::parallel_for(0, e.height, 8, [&](int64_t begin, int64_t end) {
    std::vector<float> w(e.width);
    for (int64_t y = begin; y < end; ++y) {
      float* sum = sums + y * e.width;
      const auto out_row = [&](int64_t k) { return out + (k * e.height + y) * e.width; };
      for (int64_t x = 0; x < e.width; ++x) sum[x] = own_weight[y * e.width + x];
      for (int64_t k = 0; k < v.channels; ++k)
        for (int64_t x = 0; x < e.width; ++x) out_row(k)[x] = sum[x] * v.row(k, y)[x];
      for_taps(y, e.height, e.width, dilation, [&](int64_t dy, int64_t dx, int64_t first, int64_t last) {
        pair_weights(e, y, dy, dx, first, last, w.data());
        for (int64_t x = first; x < last; ++x) sum[x] += w[x];
        for (int64_t k = 0; k < v.channels; ++k) {
          float* o = out_row(k);
          const float* there = v.row(k, y + dy) + dx;
          for (int64_t x = first; x < last; ++x) o[x] += w[x] * there[x];
        }
      });
      for (int64_t k = 0; k < v.channels; ++k)
        for (int64_t x = 0; x < e.width; ++x) out_row(k)[x] /= sum[x];
    }
  });
  return {means, total};
}

/// With A = d loss / d mean / sum and B = sum over the values of A * mean, the weight of neighbor q for pixel p has the
/// derivative g_pq = A_p . v_q - B_p. Everything is gathered at p, so rows are independent.
std::vector<torch::Tensor> backward(torch::Tensor embedding, torch::Tensor own, torch::Tensor values, torch::Tensor a,
                                    torch::Tensor b, int64_t dilation) {
  torch::Tensor grad_embedding = torch::zeros_like(embedding), grad_own = torch::zeros_like(own), grad_values = torch::empty_like(values);
  const Planes e = planes(embedding), v = planes(values), pa = planes(a), pb = planes(b.unsqueeze(0));
  const Planes po = planes(own.unsqueeze(0));
  float *ge = grad_embedding.data_ptr<float>(), *go = grad_own.data_ptr<float>(), *gv = grad_values.data_ptr<float>();
  at::parallel_for(0, e.height, 8, [&](int64_t begin, int64_t end) {
    std::vector<float> w(e.width), g(e.width);
    for (int64_t y = begin; y < end; ++y) {
      const auto row = [&](float* base, int64_t k) { return base + (k * e.height + y) * e.width; };
      for (int64_t x = 0; x < e.width; ++x) row(go, 0)[x] = -pb.row(0, y)[x];
      for (int64_t k = 0; k < v.channels; ++k)
        for (int64_t x = 0; x < e.width; ++x) {
          row(go, 0)[x] += pa.row(k, y)[x] * v.row(k, y)[x];
          row(gv, k)[x] = po.row(0, y)[x] * pa.row(k, y)[x];
        }
      for_taps(y, e.height, e.width, dilation, [&](int64_t dy, int64_t dx, int64_t first, int64_t last) {
        pair_weights(e, y, dy, dx, first, last, w.data());
        const float *b_here = pb.row(0, y), *b_there = pb.row(0, y + dy) + dx;
        for (int64_t x = first; x < last; ++x) g[x] = -b_here[x] - b_there[x];
        for (int64_t k = 0; k < v.channels; ++k) {
          const float *v_here = v.row(k, y), *v_there = v.row(k, y + dy) + dx, *a_here = pa.row(k, y), *a_there = pa.row(k, y + dy) + dx;
          float* to = row(gv, k);
          for (int64_t x = first; x < last; ++x) {
            g[x] += a_here[x] * v_there[x] + a_there[x] * v_here[x];
            to[x] += w[x] * a_there[x];
          }
        }
        for (int64_t x = first; x < last; ++x) g[x] *= -2 * w[x];
        for (int64_t k = 0; k < e.channels; ++k) {
          const float *here = e.row(k, y), *there = e.row(k, y + dy) + dx;
          float* to = row(ge, k);
          for (int64_t x = first; x < last; ++x) to[x] += g[x] * (here[x] - there[x]);
        }
      });
    }
  });
  return {grad_embedding, grad_own, grad_values};
}

}  // namespace

PYBIND11_MODULE(TORCH_EXTENSION_NAME, m) {
  m.def("forward", &forward, "one pass: embedding [K,H,W], own weight [H,W], values [M,H,W], dilation -> means, sum of weights");
  m.def("backward", &backward, "its derivatives");
}
