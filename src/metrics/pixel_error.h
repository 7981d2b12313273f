// Errors that know no neighbors: each value against its reference.
#pragma once

#include "metrics/planes.h"
#include "rpf/metrics.h"

namespace rpf::metrics {

double mean_squared_error(const Pair& pair);
double mean_absolute_error(const Pair& pair);
/// Sum of the image / sum of the reference; 1 where the sums are equal.
double energy_ratio(const Pair& pair);
/// Decibels of the peak 1 over the root of the mean squared error; `shown` has gone through the tone curve.
double peak_signal_to_noise(const Pair& shown);
/// Mean over R, G, B of (a - b)^2 / (b^2 + 0.01), for each pixel.
Plane relative_squared_error(const Pair& pair);
/// Mean of all but the largest thousandth of the values, rounded down; NaN is larger than any number.
double trimmed_mean(Plane errors);
/// For each channel, the first pixel of the largest |a - b|, in the coordinates of `window`.
std::array<LargestDifference, 3> largest_differences(const Pair& pair, const Window& window);

}  // namespace rpf::metrics
