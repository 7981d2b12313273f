#include "plan/leaf_metrics.h"

#include <cmath>

#include "frame/variables.h"
#include "parallel/workers.h"

namespace rpf {
namespace {

constexpr std::size_t of_plane = 32;   ///< samples that a gradient is of
constexpr std::size_t of_tensor = 8;   ///< samples that a tensor is the mean over
constexpr double least_spread = 1e-9;  ///< part of all spread that each dimension has at least
constexpr double roundness = 0.01;     ///< of the largest steepness that each direction has at least
constexpr std::size_t dimensions = RPF_DIMENSIONS, colors = 3;

using Matrix = std::array<ColumnPlace, dimensions>;

/// The lower triangle of a positive definite matrix whose product with its transpose is the matrix.
Matrix root_of(Matrix a) {
  for (std::size_t i = 0; i < dimensions; ++i)
    for (std::size_t j = i; j < dimensions; ++j) {
      double left = a[j][i];
      for (std::size_t k = 0; k < i; ++k) left -= a[i][k] * a[j][k];
      a[j][i] = j == i ? std::sqrt(left) : left / a[i][i];
    }
  return a;
}

/// x of a x = b, of a's root.
ColumnPlace solve(const Matrix& root, ColumnPlace b) {
  for (std::size_t i = 0; i < dimensions; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= root[i][k] * b[k];
    b[i] /= root[i][i];
  }
  for (std::size_t i = dimensions; i-- > 0;) {
    for (std::size_t k = i + 1; k < dimensions; ++k) b[i] -= root[k][i] * b[k];
    b[i] /= root[i][i];
  }
  return b;
}

double trace(const Matrix& a) {
  double sum = 0;
  for (std::size_t i = 0; i < dimensions; ++i) sum += a[i][i];
  return sum;
}

/// a += v w^T
void add_product(const ColumnPlace& v, const ColumnPlace& w, Matrix& a) {
  for (std::size_t i = 0; i < dimensions; ++i)
    for (std::size_t j = 0; j < dimensions; ++j) a[i][j] += v[i] * w[j];
}

class LeafMetrics {
 public:
  LeafMetrics(const SampleTree& tree, const Frame& frame)
      : tree_(tree), frame_(frame), tensors_(tree.leaves), leaf_of_(tree.samples.size()) {
    for (std::uint32_t leaf = 0; leaf < tree.leaves; ++leaf)
      for (std::uint32_t i = tree.first[leaf]; i < tree.first[leaf + 1]; ++i) leaf_of_[i] = leaf;
  }

  /// (12.3): sum over the colors of g g^T, g the gradient of the plane through the samples around.
  void find_tensor(std::uint32_t leaf) {
    const std::vector<std::uint32_t> around = nearest_samples(tree_, middle(leaf), of_plane);
    ColumnPlace mean = {};
    std::array<double, colors> mean_color = {};
    for (const std::uint32_t i : around) {
      for (std::size_t k = 0; k < dimensions; ++k) mean[k] += tree_.place(i)[k];
      for (std::size_t c = 0; c < colors; ++c) mean_color[c] += color(i)[c];
    }
    const auto count = static_cast<double>(around.size());
    for (double& x : mean) x /= count;
    for (double& x : mean_color) x /= count;
    Matrix spread = {};
    std::array<ColumnPlace, colors> slope = {};
    for (const std::uint32_t i : around) {
      ColumnPlace off;
      for (std::size_t k = 0; k < dimensions; ++k) off[k] = tree_.place(i)[k] - mean[k];
      add_product(off, off, spread);
      for (std::size_t c = 0; c < colors; ++c)
        for (std::size_t k = 0; k < dimensions; ++k) slope[c][k] += off[k] * (color(i)[c] - mean_color[c]);
    }
    add_gradients(spread, slope, tensors_[leaf]);
  }

  /// (12.4) and (12.5), once all tensors are there.
  void find_metric(std::uint32_t leaf, float* to) const {
    Matrix tensor = {};
    for (const std::uint32_t i : nearest_samples(tree_, middle(leaf), of_tensor))
      for (std::size_t k = 0; k < dimensions; ++k)
        for (std::size_t l = 0; l < dimensions; ++l) tensor[k][l] += tensors_[leaf_of_[i]][k][l];
    const double all = trace(tensor);
    const bool is_steep = all > 0 && std::isfinite(all);
    for (std::size_t k = 0; k < dimensions; ++k)
      for (std::size_t l = 0; l < dimensions; ++l)
        tensor[k][l] = (is_steep ? tensor[k][l] / all : 0) + (k == l ? roundness : 0);
    for (std::size_t k = 0; k < dimensions; ++k)
      for (std::size_t l = k; l < dimensions; ++l) *to++ = static_cast<float>((k == l ? 1 : 2) * tensor[k][l]);
    const Matrix root = root_of(tensor);
    for (std::size_t k = 0; k < dimensions; ++k) {
      ColumnPlace unit = {};
      unit[k] = 1;
      *to++ = static_cast<float>(1 / solve(root, unit)[k]);
    }
  }

 private:
  const float* color(std::uint32_t i) const { return frame_.record(tree_.samples[i]) + Variables::color; }

  ColumnPlace middle(std::uint32_t leaf) const {
    ColumnPlace middle = {};
    for (std::uint32_t i = tree_.first[leaf]; i < tree_.first[leaf + 1]; ++i)
      for (std::size_t k = 0; k < dimensions; ++k) middle[k] += tree_.place(i)[k];
    for (double& x : middle) x /= tree_.first[leaf + 1] - tree_.first[leaf];
    return middle;
  }

  static void add_gradients(Matrix spread, const std::array<ColumnPlace, colors>& slope, Matrix& tensor) {
    const double all = trace(spread);
    if (!(all > 0)) return;
    for (std::size_t k = 0; k < dimensions; ++k) spread[k][k] += least_spread * all;
    const Matrix root = root_of(spread);
    for (const ColumnPlace& s : slope) {
      const ColumnPlace gradient = solve(root, s);
      add_product(gradient, gradient, tensor);
    }
  }

  const SampleTree& tree_;
  const Frame& frame_;
  std::vector<Matrix> tensors_;
  std::vector<std::uint32_t> leaf_of_;  ///< [sample by leaf]
};

}  // namespace

std::vector<float> leaf_metrics(const SampleTree& tree, const Frame& frame, int threads,
                                const std::function<void()>& check) {
  LeafMetrics all(tree, frame);
  std::vector<float> metrics(std::size_t{tree.leaves} * RPF_METRIC);
  Workers workers(threads);
  const auto for_leaves = [&](const auto& body) {
    constexpr std::uint32_t piece = 256, at_once = 128 * piece;  // some tenths of a second
    for (std::uint32_t begin = 0; begin < tree.leaves; begin += at_once) {
      const std::uint32_t end = std::min(tree.leaves, begin + at_once);
      workers.for_all(begin / piece, (end + piece - 1) / piece, [&](std::size_t p, std::size_t /*worker*/) {
        const auto first = static_cast<std::uint32_t>(p) * piece;
        for (std::uint32_t leaf = first; leaf < std::min(end, first + piece); ++leaf) body(leaf);
      });
      check();
    }
  };
  for_leaves([&](std::uint32_t leaf) { all.find_tensor(leaf); });
  for_leaves([&](std::uint32_t leaf) { all.find_metric(leaf, &metrics[std::size_t{leaf} * RPF_METRIC]); });
  return metrics;
}

}  // namespace rpf
