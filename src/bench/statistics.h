// What repeated measurements say, and what they do not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rpf::bench {

/// The middle value; the mean of the two middle ones where the number is even. `values` is not empty.
double median(std::vector<double> values);

struct Summary {
  double median = 0, lowest = 0, highest = 0;
};

/// `values` is not empty.
Summary summarize(const std::vector<double>& values);

/// The ranks (1: the smallest) between which the true median of n independent values lies, and how surely. No
/// distribution is assumed: the number of values below the median is binomial with p = 1/2 (sign test).
struct MedianRanks {
  std::size_t low = 0, high = 0;  ///< 0: too few values for any interval of `least_confidence`
  double confidence = 0;
};

/// How sure a verdict has to be.
constexpr double least_confidence = 0.95;

/// The narrowest such interval of at least `least_confidence`; there is none below 6 values.
MedianRanks median_ranks(std::size_t n);

enum class Verdict { too_few_rounds, no_difference, less, more };

/// b / a over rounds in which both were measured next to each other.
struct Ratio {
  double median = 1, low = 1, high = 1;  ///< of the rounds' ratios; low, high: where the true median is
  double confidence = 0;                 ///< 0 where there are too few rounds
  Verdict verdict = Verdict::too_few_rounds;
};

/// `a` and `b` have an entry for each round, above 0. The verdict is a difference only where the interval excludes 1.
Ratio compare_rounds(const std::vector<double>& a, const std::vector<double>& b);

/// In words, for b against a: "B takes less", "no difference", ...
std::string text_of(Verdict verdict);

}  // namespace rpf::bench
