#include "frame/feature_spread.h"

#include <algorithm>
#include <cmath>

namespace rpf {
namespace {

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

}  // namespace rpf
