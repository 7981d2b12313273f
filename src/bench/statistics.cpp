#include "bench/statistics.h"

#include <algorithm>
#include <cmath>

namespace rpf::bench {
namespace {

/// Probability that of n fair coins exactly k show heads.
double binomial_half(std::size_t n, std::size_t k) {
  const auto log_factorial = [](std::size_t i) { return std::lgamma(static_cast<double>(i) + 1); };
  return std::exp(log_factorial(n) - log_factorial(k) - log_factorial(n - k) - static_cast<double>(n) * std::log(2.0));
}

Verdict verdict_of(const Ratio& ratio) {
  if (ratio.high < 1) return Verdict::less;
  return ratio.low > 1 ? Verdict::more : Verdict::no_difference;
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

Summary summarize(const std::vector<double>& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return {median(values), *lowest, *highest};
}

MedianRanks median_ranks(std::size_t n) {
  MedianRanks ranks;
  double outside = 0;  // probability that the median is below the value of rank `low`, or, as much, above its mirror
  for (std::size_t low = 1; 2 * low <= n; ++low) {
    outside += binomial_half(n, low - 1);
    if (1 - 2 * outside < least_confidence) break;
    ranks = {low, n + 1 - low, 1 - 2 * outside};
  }
  return ranks;
}

Ratio compare_rounds(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < a.size(); ++round) ratios.push_back(b[round] / a[round]);
  std::sort(ratios.begin(), ratios.end());
  Ratio result;
  result.median = median(ratios);
  const MedianRanks ranks = median_ranks(ratios.size());
  if (ranks.low == 0) {
    result.low = ratios.front();
    result.high = ratios.back();
    return result;
  }
  result.low = ratios[ranks.low - 1];
  result.high = ratios[ranks.high - 1];
  result.confidence = ranks.confidence;
  result.verdict = verdict_of(result);
  return result;
}

std::string text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::too_few_rounds:
      return "no verdict: at least 6 rounds are needed";
    case Verdict::no_difference:
      return "no difference beyond the spread";
    case Verdict::less:
      return "B takes less";
    case Verdict::more:
      return "B takes more";
  }
  return "";
}

}  // namespace rpf::bench
