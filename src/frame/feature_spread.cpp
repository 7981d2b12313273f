#include "frame/feature_spread.h"

#include <algorithm>
#include <cmath>

namespace rpf {

double FeatureSpreadScan::Moments::mean() const { return sum / std::max(count, 1.0); }

double FeatureSpreadScan::Moments::variance() const { return squares / std::max(count, 1.0); }

void FeatureSpreadScan::add(const Frame& frame) {
  const std::size_t first = variables_.features(), samples = frame.records.size() / frame.variables;
  for (std::size_t k = 0; k < moments_.size(); ++k)
    for (std::size_t i = 0; i < samples; ++i) {
      const float value = frame.records[i * frame.variables + first + k];
      if (std::isnan(value)) continue;
      moments_[k].sum += value;
      ++moments_[k].count;
    }
}

void FeatureSpreadScan::add_again(const Frame& frame) {
  const std::size_t first = variables_.features(), samples = frame.records.size() / frame.variables;
  for (std::size_t k = 0; k < moments_.size(); ++k) {
    const double mean = moments_[k].mean();
    for (std::size_t i = 0; i < samples; ++i) {
      const double off = frame.records[i * frame.variables + first + k] - mean;
      if (!std::isnan(off)) moments_[k].squares += off * off;
    }
  }
}

std::vector<FeatureSpread> FeatureSpreadScan::spread() const {
  const std::vector<std::string>& names = variables_.feature_names;
  std::vector<FeatureSpread> spread;
  for (std::size_t k = 0; k < names.size(); ++k) {
    double variance = 0;
    for (std::size_t other = 0; other < names.size(); ++other)
      if (group_of_variable(names[other]) == group_of_variable(names[k])) variance += moments_[other].variance();
    spread.push_back({static_cast<float>(moments_[k].mean()), std::sqrt(variance)});
  }
  return spread;
}

std::vector<FeatureSpread> spread_of_features(const Frame& frame, const Variables& variables) {
  FeatureSpreadScan scan(variables);
  scan.add(frame);
  scan.add_again(frame);
  return scan.spread();
}

}  // namespace rpf
