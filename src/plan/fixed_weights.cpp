#include "plan/fixed_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rpf {
namespace {

/// Colors are below 2^41 and features within 2^36 of this scale's inverse, so that differences stay finite.
constexpr double largest_scale = 0x1p80;

/// Below it even the largest difference of colors adds nothing to a distance.
constexpr double smallest_scale = 0x1p-100;

float scale_of(double sigma) {
  const double scale = std::min(1 / (std::sqrt(2.0) * sigma), largest_scale);
  return scale < smallest_scale ? 0.0F : static_cast<float>(scale);
}

/// Mean and variance of one variable over all samples that have it.
struct Moments {
  double mean = 0, variance = 0;
};

Moments moments_of(const Frame& frame, std::size_t variable) {
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    if (std::isnan(frame.record(i)[variable])) continue;
    sum += frame.record(i)[variable];
    ++count;
  }
  const double mean = sum / std::max(count, 1.0);
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    const double off = frame.record(i)[variable] - mean;
    if (!std::isnan(off)) squares += off * off;
  }
  return {mean, squares / std::max(count, 1.0)};
}

/// Most samples of the pixels in a box that lies in the frame.
std::uint32_t largest_box(const FrameFacts& facts, int box_width) {
  const auto side = [&](int length) { return static_cast<std::uint64_t>(std::min(box_width, std::max(length, 1))); };
  const std::uint64_t samples = side(facts.width) * side(facts.height) * facts.max_samples_per_pixel;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(samples, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

std::vector<FeatureSpread> spread_of_features(const Frame& frame, const Variables& variables) {
  const std::vector<std::string>& names = variables.feature_names;
  std::vector<Moments> moments;
  for (std::size_t k = 0; k < names.size(); ++k) moments.push_back(moments_of(frame, variables.features() + k));
  std::vector<FeatureSpread> spread;
  for (std::size_t k = 0; k < names.size(); ++k) {
    double variance = 0;
    for (std::size_t other = 0; other < names.size(); ++other)
      if (group_of_variable(names[other]) == group_of_variable(names[k])) variance += moments[other].variance;
    spread.push_back({static_cast<float>(moments[k].mean), std::sqrt(variance)});
  }
  return spread;
}

std::vector<float> centers_of(const FrameFacts& facts, const Settings& settings) {
  if (settings.method == Method::rpf) return {};
  std::vector<float> centers(facts.variables.count(), 0.0F);
  for (std::size_t k = 0; k < facts.feature_spread.size(); ++k)
    centers[facts.variables.features() + k] = facts.feature_spread[k].mean;
  return centers;
}

void plan_fixed_weights(const FrameFacts& facts, const Settings& settings, PassPlan& pass) {
  const auto add = [&](std::size_t variable, double sigma) {
    const float scale = scale_of(sigma);
    if (scale > 0) pass.coordinates.push_back({static_cast<std::uint32_t>(variable), scale});
  };
  for (std::size_t axis = 0; axis < 2; ++axis) add(Variables::position + axis, pass.box_width / 4.0);
  for (std::size_t c = 0; c < 3 && settings.method != Method::gaussian; ++c)
    add(Variables::color + c, static_cast<double>(settings.sigma_color) * facts.radiance_scale);
  for (std::size_t k = 0; k < facts.feature_spread.size(); ++k)
    add(facts.variables.features() + k, settings.sigma_feature * facts.feature_spread[k].deviation);
  pass.max_neighbors = largest_box(facts, pass.box_width);
  pass.fixed_weights = std::uint64_t{pass.max_neighbors} * facts.max_samples_per_pixel;
}

}  // namespace rpf
