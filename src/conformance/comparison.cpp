#include "conformance/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rpf {
namespace {

constexpr std::uint64_t incomparable = std::numeric_limits<std::uint64_t>::max();

/// Floats in their order, as integers: neighbors differ by 1, -0 comes right before +0.
std::int64_t rank(float value) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits >= 0 ? bits : -1 - static_cast<std::int64_t>(bits & 0x7FFFFFFF);
}

std::uint64_t distance(float a, float b) { return ulp_distance(a, b); }
std::uint64_t distance(std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; }

std::string text(float value) { return fmt::format("{:a} ({:.9g})", value, value); }
std::string text(std::uint32_t value) { return fmt::format("{}", value); }

std::vector<std::uint32_t> widened(const std::vector<std::uint8_t>& values) { return {values.begin(), values.end()}; }

std::vector<float> triple(const float* values) { return {values, values + 3}; }

}  // namespace

std::uint64_t ulp_distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : incomparable;
  const std::int64_t difference = rank(a) - rank(b);
  return static_cast<std::uint64_t>(std::abs(difference));
}

void Comparison::at(int pass, std::string place) {
  pass_ = pass;
  place_ = std::move(place);
}

StageResult& Comparison::stage(const std::string& name) {
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&](const StageResult& s) { return s.stage == name; });
  if (found != stages_.end()) return *found;
  stages_.push_back({name, 0, 0, 0});
  return stages_.back();
}

template <typename T>
void Comparison::compare(const std::string& name, const std::vector<T>& reference, const std::vector<T>& device) {
  StageResult& result = stage(name);
  const std::string where = fmt::format("pass {}, {}: {}", pass_ + 1, place_, name);
  result.compared += reference.size();
  if (reference.size() != device.size()) {
    ++result.different;
    result.largest_ulp = incomparable;
    if (first_difference_.empty())
      first_difference_ =
          fmt::format("{} has {} values on the device, {} in the reference", where, device.size(), reference.size());
    return;
  }
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const std::uint64_t apart = distance(reference[i], device[i]);
    if (apart == 0) continue;
    ++result.different;
    result.largest_ulp = std::max(result.largest_ulp, apart);
    if (first_difference_.empty())
      first_difference_ =
          fmt::format("{}[{}] is {} on the device, {} in the reference", where, i, text(device[i]), text(reference[i]));
  }
}

void Comparison::values(const std::string& stage, const std::vector<float>& reference,
                        const std::vector<float>& device) {
  compare(stage, reference, device);
}

void Comparison::counts(const std::string& stage, const std::vector<std::uint32_t>& reference,
                        const std::vector<std::uint32_t>& device) {
  compare(stage, reference, device);
}

void Comparison::traces(const PixelTrace& r, const PixelTrace& d) {
  const FilterWeights &a = r.filter_weights, &b = d.filter_weights;
  values("shift", r.shift, d.shift);
  values("own mean", r.own_mean, d.own_mean);
  values("own deviation", r.own_deviation, d.own_deviation);
  values("tolerance", r.tolerance, d.tolerance);
  counts("neighbors", r.neighbors, d.neighbors);
  values("mean", r.mean, d.mean);
  values("deviation", r.inverse_deviation, d.inverse_deviation);
  values("normalized", r.normalized, d.normalized);
  counts("bins", widened(r.bins), widened(d.bins));
  counts("histograms", r.histograms, d.histograms);
  values("information", r.mutual_information, d.mutual_information);
  values("W", triple(a.color.color_fraction_random), triple(b.color.color_fraction_random));
  values("W", {a.color.fraction_random}, {b.color.fraction_random});
  values("W", a.feature_fraction_random, b.feature_fraction_random);
  values("W", a.fraction_feature, b.fraction_feature);
  values("alpha", triple(a.color.alpha), triple(b.color.alpha));
  values("beta", a.beta, b.beta);
  values("weights", r.weights, d.weights);
  values("filtered", r.filtered, d.filtered);
  values("colors", r.colors, d.colors);
}

void Comparison::statistics(const std::vector<PixelStatistics>& reference, const std::vector<PixelStatistics>& device) {
  const auto split = [](const std::vector<PixelStatistics>& pixels, std::vector<std::uint32_t>& counts,
                        std::vector<float>& means) {
    for (const PixelStatistics& p : pixels) {
      counts.insert(counts.end(), {p.drawn, p.neighbors});
      means.insert(means.end(), {p.fraction_random, p.alpha, p.beta});
    }
  };
  std::vector<std::uint32_t> counts_r, counts_d;
  std::vector<float> means_r, means_d;
  split(reference, counts_r, means_r);
  split(device, counts_d, means_d);
  counts("statistics", counts_r, counts_d);
  values("statistics", means_r, means_d);
}

}  // namespace rpf
