// Where the values of the features lie: what the methods with fixed weights measure distances in.
#pragma once

#include <vector>

#include "frame/facts.h"
#include "frame/frame.h"

namespace rpf {

/// Means and deviations of the features, missing values left out.
std::vector<FeatureSpread> spread_of_features(const Frame& frame, const Variables& variables);

}  // namespace rpf
