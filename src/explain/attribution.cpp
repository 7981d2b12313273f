#include "explain/attribution.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "explain/blur.h"
#include "parallel/workers.h"

namespace rpf {
namespace {

/// The part of all pairs of samples that are close to each other in a group's parameters.
constexpr double close_pairs = 0.12;
/// Samples of a pixel that are paired, at most.
constexpr std::uint32_t most_paired = 16;
/// Standard errors that are subtracted: what could be chance counts as nothing.
constexpr float certainty = 1;
/// Between them the caller may stop.
constexpr int rows_at_once = 16;
/// The pixel itself and half of those around it: each pair of neighboring pixels once.
constexpr std::array<std::array<int, 2>, 5> partners = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

using Plane = std::vector<float>;
using Color = std::array<float, 3>;

/// Sums over pairs of samples, [pixel]. A pair's product is that of their deviations from the mean around, summed over
/// R, G and B: its expectation is their covariance.
struct PairSums {
  Plane product, squared_product, count;

  explicit PairSums(std::size_t pixels) : product(pixels), squared_product(pixels), count(pixels) {}
  void add(std::size_t pixel, float value) {
    product[pixel] += value;
    squared_product[pixel] += value * value;
    count[pixel] += 1;
  }
};

/// Components that differ by less than this are close.
float close_distance(std::size_t components) {
  // Two uniform numbers are closer than h with the probability 2 h - h^2.
  return static_cast<float>(1 - std::sqrt(1 - std::pow(close_pairs, 1.0 / static_cast<double>(components))));
}

bool is_close(const RandomGroup& group, float distance, const float* a, const float* b) {
  return std::all_of(group.columns.begin(), group.columns.end(),
                     [&](std::size_t column) { return std::fabs(a[column] - b[column]) < distance; });
}

/// Number of the i-th of `count` samples that are paired, of all of the pixel.
std::uint32_t chosen(const Frame& frame, std::size_t pixel, std::uint32_t i, std::uint32_t count) {
  return frame.first_sample[pixel] + static_cast<std::uint32_t>(std::uint64_t{i} * frame.samples(pixel) / count);
}

class Pairing {
 public:
  Pairing(const Frame& frame, const std::vector<RandomGroup>& groups)
      : frame_(frame),
        groups_(groups),
        means_(pixel_means()),
        all_(frame.first_sample.size() - 1),
        own_(frame.first_sample.size() - 1) {
    for (const RandomGroup& group : groups) {
      distances_.push_back(close_distance(group.columns.size()));
      close_.emplace_back(frame.first_sample.size() - 1);
    }
  }

  Attribution attribute(int threads, const std::function<void()>& after_rows) {
    Workers workers(threads);
    for (int begin = 0; begin < frame_.height; begin += rows_at_once) {
      const int end = std::min(begin + rows_at_once, frame_.height);
      workers.for_all(static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
                      [&](std::size_t y, std::size_t /*worker*/) {
                        for (int x = 0; x < frame_.width; ++x) pair_pixel(x, static_cast<int>(y));
                      });
      after_rows();
    }
    Attribution result;
    const Plane covariance = mean_product(all_);
    result.variance = mean_product(own_);
    for (std::size_t p = 0; p < covariance.size(); ++p)
      result.variance[p] = std::max(result.variance[p] - covariance[p], 0.0F);
    for (PairSums& close : close_) result.caused.push_back(evident(close, covariance));
    return result;
  }

 private:
  std::size_t pixel_at(int x, int y) const { return static_cast<std::size_t>(y) * frame_.width + x; }

  std::vector<Color> pixel_means() const {
    std::vector<Color> means(frame_.first_sample.size() - 1);
    for (std::size_t p = 0; p < means.size(); ++p) {
      for (std::uint32_t i = frame_.first_sample[p]; i < frame_.first_sample[p + 1]; ++i)
        for (std::size_t c = 0; c < 3; ++c) means[p][c] += attribution_unit * frame_.record(i)[c];
      for (float& mean : means[p]) mean /= static_cast<float>(std::max(frame_.samples(p), 1U));
    }
    return means;
  }

  /// Over the 3x3 pixels around that have samples.
  Color mean_around(int x, int y) const {
    Color mean{};
    float count = 0;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, frame_.height - 1); ++j)
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, frame_.width - 1); ++i) {
        if (frame_.samples(pixel_at(i, j)) == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) mean[c] += means_[pixel_at(i, j)][c];
        ++count;
      }
    for (float& value : mean) value /= std::max(count, 1.0F);
    return mean;
  }

  void pair_pixel(int x, int y) {
    const std::size_t pixel = pixel_at(x, y);
    const std::uint32_t own = std::min(frame_.samples(pixel), most_paired);
    const Color mean = mean_around(x, y);
    for (std::uint32_t i = 0; i < own; ++i) {
      const float* a = frame_.record(chosen(frame_, pixel, i, own));
      own_.add(pixel, product(a, mean, a, mean));
    }
    for (const auto& [dx, dy] : partners) {
      if (x + dx < 0 || x + dx >= frame_.width || y + dy >= frame_.height) continue;
      const std::size_t partner = pixel_at(x + dx, y + dy);
      const std::uint32_t others = std::min(frame_.samples(partner), most_paired);
      const Color other_mean = mean_around(x + dx, y + dy);
      for (std::uint32_t i = 0; i < own; ++i)
        for (std::uint32_t j = partner == pixel ? i + 1 : 0; j < others; ++j)
          add_pair(pixel, frame_.record(chosen(frame_, pixel, i, own)), mean,
                   frame_.record(chosen(frame_, partner, j, others)), other_mean);
    }
  }

  static float product(const float* a, const Color& mean_a, const float* b, const Color& mean_b) {
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += (attribution_unit * a[c] - mean_a[c]) * (attribution_unit * b[c] - mean_b[c]);
    return sum;
  }

  void add_pair(std::size_t pixel, const float* a, const Color& mean_a, const float* b, const Color& mean_b) {
    const float value = product(a, mean_a, b, mean_b);
    all_.add(pixel, value);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (is_close(groups_[g], distances_[g], a, b)) close_[g].add(pixel, value);
  }

  void blur_plane(Plane& plane, float sigma) const { blur(plane, frame_.width, frame_.height, sigma); }

  /// Means over the window; 0 where it has no pair.
  Plane mean_product(PairSums& sums) const {
    blur_plane(sums.product, attribution_sigma);
    blur_plane(sums.count, attribution_sigma);
    Plane mean(sums.count.size());
    for (std::size_t p = 0; p < mean.size(); ++p) mean[p] = sums.count[p] > 0 ? sums.product[p] / sums.count[p] : 0;
    return mean;
  }

  /// How much more close pairs have in common than all pairs, less what could be chance.
  Plane evident(PairSums& close, const Plane& covariance) const {
    Plane caused = mean_product(close);
    // The standard error of a weighted mean has the squares of the weights: of a Gaussian, a narrower Gaussian.
    blur_plane(close.squared_product, attribution_sigma / std::sqrt(2.0F));
    for (std::size_t p = 0; p < caused.size(); ++p) {
      const float error = close.count[p] > 0 ? std::sqrt(close.squared_product[p]) / close.count[p] : 0;
      caused[p] = std::max(caused[p] - covariance[p] - certainty * error, 0.0F);
    }
    return caused;
  }

  const Frame& frame_;
  const std::vector<RandomGroup>& groups_;
  std::vector<Color> means_;
  PairSums all_, own_;
  std::vector<float> distances_;  ///< [group]
  std::vector<PairSums> close_;   ///< [group]
};

}  // namespace

std::vector<RandomGroup> random_groups(const Variables& variables) {
  std::vector<RandomGroup> groups;
  for (std::size_t j = 0; j < variables.random_names.size(); ++j) {
    const std::string name = group_of_variable(variables.random_names[j]);
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const RandomGroup& g) { return g.name == name; });
    RandomGroup& group = found != groups.end() ? *found : groups.emplace_back(RandomGroup{name, {}});
    group.columns.push_back(Variables::random + j);
  }
  return groups;
}

float Attribution::share(std::size_t group, std::size_t pixel) const {
  float sum = 0;
  for (const std::vector<float>& plane : caused) sum += plane[pixel];
  return sum > 0 ? caused[group][pixel] / sum : 0;
}

float Attribution::explained(std::size_t pixel) const {
  float sum = 0;
  for (const std::vector<float>& plane : caused) sum += plane[pixel];
  return sum > 0 ? std::min(sum / std::max(variance[pixel], sum), 1.0F) : 0;
}

Attribution attribute_noise(const Frame& frame, const std::vector<RandomGroup>& groups, int threads,
                            const std::function<void()>& after_rows) {
  return Pairing(frame, groups).attribute(threads, after_rows);
}

std::uint64_t attribution_bytes(std::uint64_t pixels, std::size_t groups) {
  constexpr std::uint64_t planes_of_sums = 3, color = 3;
  return pixels * sizeof(float) * (planes_of_sums * (2 + groups) + color + 2 + groups);
}

}  // namespace rpf
