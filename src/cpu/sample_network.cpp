#include "cpu/sample_network.h"

#include <algorithm>

#include "parallel/vectors.h"

namespace rpf {
namespace {

using kernel::fma;

// Behind the S features of a sample: where the values stand that moments are taken of.
constexpr std::size_t color_at = 0, luminance_at = 3, guides_at = 4, base_at = guides_at + RPF_GUIDES,
                      moment_values = base_at + 3;

}  // namespace

SampleNetwork::SampleNetwork(const Frame& frame, const EstimatePlan& plan)
    : frame_(frame), plan_(plan), sample1_(with_inputs(plan.network->sample1(), plan.live)), live_(plan.live.size()) {
  const auto features = static_cast<std::size_t>(plan.network->sample_features);
  seen_.features.resize(features);
  seen_.hidden.resize(features);
  weighed_.resize(features + RPF_CONTEXT);
  for (std::vector<float>* v : {&current_, &first_, &sums_, &squares_}) v->resize(features + moment_values);
}

void SampleNetwork::fill_inputs(const float* record) {
  const auto value = [&](int input) {
    const int column = plan_.column[static_cast<std::size_t>(input)];
    return column < 0 ? 0.0F : record[column];
  };
  for (const int input : plan_.live)
    if (input >= RPF_INPUT_NORMAL) seen_.inputs[input] = value(input);
  for (int i = 0; i < 3; ++i) {
    const float c = kernel::rpf_seen_color(record[i], plan_.exposure);
    const float a =
        plan_.has_albedo ? kernel::rpf_albedo_base(value(RPF_INPUT_ALBEDO + i), value(RPF_INPUT_MISS)) : 1.0F;
    seen_.color[i] = c;
    seen_.base[i] = a;
    seen_.inputs[RPF_INPUT_BRIGHTNESS + i] = kernel::rpf_brightness(c);
    seen_.inputs[RPF_INPUT_BRIGHTNESS_OVER + i] = kernel::rpf_brightness_over(c, a);
  }
}

const SeenSample& SampleNetwork::see(std::size_t sample) {
  const Network& network = *plan_.network;
  fill_inputs(frame_.record(sample));
  for (std::size_t i = 0; i < live_.size(); ++i) live_[i] = seen_.inputs[plan_.live[i]];
  dense(sample1_, live_.data(), 0, network.sample_features, seen_.hidden.data());
  activate(seen_.hidden.data(), network.sample_features);
  dense(network.sample2(), seen_.hidden.data(), 0, network.sample_features, seen_.features.data());
  activate(seen_.features.data(), network.sample_features);
  return seen_;
}

void SampleNetwork::fill_moment_values() {
  float* behind = std::copy(seen_.features.begin(), seen_.features.end(), current_.data());
  std::copy_n(seen_.color, 3, behind + color_at);
  behind[luminance_at] = kernel::rpf_luminance(seen_.color[0], seen_.color[1], seen_.color[2]);
  std::copy_n(seen_.inputs + RPF_INPUT_NORMAL, RPF_GUIDES, behind + guides_at);
  std::copy_n(seen_.base, 3, behind + base_at);
}

float SampleNetwork::mean(std::size_t k, float samples) const {
  return kernel::rpf_shifted_mean(first_[k], sums_[k], 1 / samples);
}

float SampleNetwork::variance(std::size_t k, float samples) const {
  return kernel::rpf_shifted_variance(sums_[k], squares_[k], 1 / samples);
}

void SampleNetwork::fill_pixel_values(float samples, float* values) const {
  const std::size_t features = seen_.features.size();
  for (std::size_t k = 0; k < features; ++k) {
    values[k] = mean(k, samples);
    values[features + k] = kernel::rpf_feature_deviation(variance(k, samples));
  }
  float* statistics = values + 2 * features;
  for (std::size_t i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_BRIGHTNESS + i] = kernel::rpf_brightness(mean(features + color_at + i, samples));
  const std::size_t luminance = features + luminance_at, guides = features + guides_at;
  statistics[RPF_STATISTIC_ERROR] =
      kernel::rpf_relative_error(variance(luminance, samples), mean(luminance, samples), samples);
  for (std::size_t i = 0; i < RPF_GUIDES; ++i) statistics[RPF_STATISTIC_GUIDES + i] = mean(guides + i, samples);
  for (std::size_t i = 0; i < 3; ++i)
    statistics[RPF_STATISTIC_SPREADS + i] =
        kernel::sqrt(variance(guides + 3 * i, samples) + variance(guides + 3 * i + 1, samples) +
                     variance(guides + 3 * i + 2, samples));
  statistics[RPF_STATISTIC_SAMPLES] = 1.0F / kernel::sqrt(samples);
}

void SampleNetwork::add_moments() {
  with_avx2([&] {
    for (std::size_t k = 0; k < current_.size(); ++k) {
      const float d = current_[k] - first_[k];
      sums_[k] += d;
      squares_[k] = fma(d, d, squares_[k]);
    }
  });
}

void SampleNetwork::see_pixel(std::size_t pixel, float* values, float* albedo) {
  const std::uint32_t begin = frame_.first_sample[pixel], end = frame_.first_sample[pixel + 1];
  std::fill_n(values, kernel::rpf_pixel_values(static_cast<kernel::uint>(seen_.features.size())), 0.0F);
  std::fill_n(albedo, RPF_ALBEDO_SUMS, 0.0F);
  if (begin == end) return;
  std::fill(sums_.begin(), sums_.end(), 0.0F);
  std::fill(squares_.begin(), squares_.end(), 0.0F);
  for (std::uint32_t sample = begin; sample < end; ++sample) {
    see(sample);
    fill_moment_values();
    if (sample == begin) first_ = current_;
    add_moments();
  }
  const auto samples = static_cast<float>(end - begin);
  fill_pixel_values(samples, values);
  for (std::size_t i = 0; i < 3; ++i) albedo[i] = mean(seen_.features.size() + base_at + i, samples);
  albedo[3] = 1;
}

float SampleNetwork::weight(const float* context) {
  const Network& network = *plan_.network;
  std::copy_n(context, RPF_CONTEXT, std::copy(seen_.features.begin(), seen_.features.end(), weighed_.data()));
  float hidden[RPF_WEIGHT_FEATURES], logit = 0;
  dense(network.weight1(), weighed_.data(), 0, RPF_WEIGHT_FEATURES, hidden);
  activate(hidden, RPF_WEIGHT_FEATURES);
  dense(network.weight2(), hidden, 0, 1, &logit);
  return kernel::rpf_learned_weight(logit);
}

}  // namespace rpf
