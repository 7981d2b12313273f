// Where the values of the features lie: what the methods with fixed weights measure distances in.
#pragma once

#include <vector>

#include "frame/facts.h"
#include "frame/frame.h"

namespace rpf {

/// Means and deviations of the features, missing values left out; of a frame in one piece or of rows after rows, with
/// the same bits.
class FeatureSpreadScan {
 public:
  explicit FeatureSpreadScan(const Variables& variables)
      : variables_(variables), moments_(variables.feature_names.size()) {}

  /// Adds the next samples.
  void add(const Frame& frame);
  /// Adds them once more, after all of them: deviations are from the mean of all.
  void add_again(const Frame& frame);
  /// After that.
  std::vector<FeatureSpread> spread() const;

 private:
  struct Moments {
    double sum = 0, count = 0, squares = 0;

    double mean() const;
    double variance() const;
  };

  const Variables& variables_;
  std::vector<Moments> moments_;  ///< [feature]
};

/// Of a frame in one piece.
std::vector<FeatureSpread> spread_of_features(const Frame& frame, const Variables& variables);

}  // namespace rpf
