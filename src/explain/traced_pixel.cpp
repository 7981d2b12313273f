#include "explain/traced_pixel.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "rpf_math.h"

namespace rpf {
namespace {

std::vector<std::string> variable_names(const Variables& variables) {
  std::vector<std::string> names = {"R", "G", "B", "film.X", "film.Y"};
  names.insert(names.end(), variables.random_names.begin(), variables.random_names.end());
  names.insert(names.end(), variables.feature_names.begin(), variables.feature_names.end());
  return names;
}

PixelPosition position_of(std::size_t pixel, const Plan& plan, const Window& data_window) {
  const auto width = static_cast<std::size_t>(plan.width);
  return {data_window.x + static_cast<int>(pixel % width), data_window.y + static_cast<int>(pixel / width)};
}

std::size_t pixel_of_sample(const Frame& frame, std::uint32_t sample) {
  const auto next = std::upper_bound(frame.first_sample.begin(), frame.first_sample.end(), sample);
  return static_cast<std::size_t>(next - frame.first_sample.begin()) - 1;
}

/// Each neighbor once, with its share in the mean of the pixel's filtered samples.
std::vector<ExplainedNeighbor> neighbors_of(const PixelTrace& trace, const PreparedFrame& prepared, const Plan& plan,
                                            const Window& data_window) {
  const std::size_t count = trace.neighbors.size(), own = prepared.frame.samples(trace.pixel);
  std::vector<double> share(count);
  for (std::size_t i = 0; i < own; ++i) {
    const float* weights = trace.weights.data() + i * count;
    const double total = std::accumulate(weights, weights + count, 0.0);
    for (std::size_t j = 0; j < count; ++j) share[j] += weights[j] / total / static_cast<double>(own);
  }
  std::vector<ExplainedNeighbor> result;
  std::unordered_map<std::uint32_t, std::size_t> places;  // by sample
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t sample = trace.neighbors[j];
    const auto [place, is_new] = places.emplace(sample, result.size());
    if (is_new) {
      const float* color = prepared.frame.record(sample);
      ExplainedNeighbor neighbor;
      neighbor.pixel = position_of(pixel_of_sample(prepared.frame, sample), plan, data_window);
      for (std::size_t c = 0; c < 3; ++c) neighbor.color[c] = color[c] / prepared.facts.radiance_scale;
      result.push_back(neighbor);
    }
    ++result[place->second].drawn;
    result[place->second].share += static_cast<float>(share[j]);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ExplainedNeighbor& a, const ExplainedNeighbor& b) { return a.share > b.share; });
  return result;
}

/// Hands out the pairs in their order.
class PairReader {
 public:
  PairReader(const PixelTrace& trace, std::size_t cells) : trace_(trace), cells_(cells) {}

  /// The next `count` pairs of `first`; returns the sum of their information.
  float read(const std::string& first, const std::string* seconds, std::size_t count, ExplainedPixel& out) {
    const float* information = trace_.mutual_information.data() + next_;
    for (std::size_t k = 0; k < count; ++k, ++next_) {
      const auto begin = trace_.histograms.begin() + static_cast<std::ptrdiff_t>(next_ * cells_);
      out.pairs.push_back({first, seconds[k], {begin, begin + static_cast<std::ptrdiff_t>(cells_)}, information[k]});
    }
    return kernel::rpf_sum(information, static_cast<kernel::uint>(count));
  }
  /// Information of the pairs that read() would read next.
  const float* next() const { return trace_.mutual_information.data() + next_; }

 private:
  const PixelTrace& trace_;
  std::size_t cells_, next_ = 0;
};

void add_dependencies(const PixelTrace& trace, const Variables& variables, ExplainedPixel& out) {
  const std::vector<std::string> names = variable_names(variables);
  const std::string *position = &names[Variables::position], *random = &names[Variables::random],
                    *features = names.data() + variables.features();
  const std::size_t randoms = variables.random_names.size(), feature_count = variables.feature_names.size();
  const FilterWeights& weights = trace.filter_weights;
  PairReader reader(trace, out.bins * out.bins);
  std::vector<float> on_feature(feature_count);
  for (std::size_t i = 0; i < 3; ++i) {
    ExplainedColor color;
    color.name = names[i];
    color.on_position = reader.read(names[i], position, 2, out);
    color.on_random = reader.read(names[i], random, randoms, out);
    for (std::size_t k = 0; k < feature_count; ++k) on_feature[k] += reader.next()[k];
    color.on_features = reader.read(names[i], features, feature_count, out);
    color.fraction_random = weights.color.color_fraction_random[i];
    color.alpha = weights.color.alpha[i];
    out.colors.push_back(color);
  }
  for (std::size_t k = 0; k < feature_count; ++k) {
    ExplainedFeature feature;
    feature.name = features[k];
    feature.on_position = reader.read(features[k], position, 2, out);
    feature.on_random = reader.read(features[k], random, randoms, out);
    feature.fraction_random = weights.feature_fraction_random[k];
    feature.color_on_feature = on_feature[k];
    feature.fraction_feature = weights.fraction_feature[k];
    feature.beta = weights.beta[k];
    out.features.push_back(feature);
  }
}

}  // namespace

ExplainedPixel explain_trace(const PixelTrace& trace, const PreparedFrame& prepared, const Plan& plan,
                             const Window& data_window) {
  ExplainedPixel out;
  out.position = position_of(trace.pixel, plan, data_window);
  out.samples = prepared.frame.samples(trace.pixel);
  out.drawn = plan.passes[0].neighborhood.draws(out.samples);
  out.neighbors = neighbors_of(trace, prepared, plan, data_window);
  out.bins = 2 * static_cast<std::size_t>(plan.half_bins) + 1;
  add_dependencies(trace, plan.variables, out);
  out.fraction_random = trace.filter_weights.color.fraction_random;
  return out;
}

}  // namespace rpf
