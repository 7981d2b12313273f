#include "metrics/pixel_error.h"

#include <algorithm>
#include <cmath>

#include "rpf/metrics.h"

namespace rpf::metrics {
namespace {

constexpr std::size_t one_trimmed_of = 1000;

double square(double x) { return x * x; }
double squared_error(double a, double b) { return square(a - b); }
double absolute_error(double a, double b) { return std::abs(a - b); }
double relative_error(double a, double b) { return square(a - b) / (square(b) + relmse_floor); }

template <class Function>
double mean_over_channels(const Pair& pair, Function error) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += mean(combined(pair.image[c], pair.reference[c], error));
  return sum / 3;
}

/// NaN is larger than any number, so that it is trimmed first and found as the largest difference.
bool less(double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); }

LargestDifference largest_difference(const Plane& a, const Plane& b, const Window& window) {
  const Plane differences = combined(a, b, absolute_error);
  const auto largest = std::max_element(differences.values.begin(), differences.values.end(), less);
  const int index = static_cast<int>(largest - differences.values.begin());
  return {*largest, window.x + index % a.width, window.y + index / a.width};
}

}  // namespace

double mean_squared_error(const Pair& pair) { return mean_over_channels(pair, squared_error); }

double mean_absolute_error(const Pair& pair) { return mean_over_channels(pair, absolute_error); }

double energy_ratio(const Pair& pair) {
  double image_mean = 0, reference_mean = 0;
  for (const Plane& plane : pair.image) image_mean += mean(plane);
  for (const Plane& plane : pair.reference) reference_mean += mean(plane);
  return image_mean == reference_mean ? 1 : image_mean / reference_mean;
}

double peak_signal_to_noise(const Pair& shown) { return -10 * std::log10(mean_squared_error(shown)); }

Plane relative_squared_error(const Pair& pair) {
  Plane sum = combined(pair.image[0], pair.reference[0], relative_error);
  for (const std::size_t c : {1, 2})
    sum = combined(std::move(sum), combined(pair.image[c], pair.reference[c], relative_error), std::plus<>());
  return mapped(std::move(sum), [](double x) { return x / 3; });
}

double trimmed_mean(Plane errors) {
  const auto kept = static_cast<std::ptrdiff_t>(errors.values.size() - errors.values.size() / one_trimmed_of);
  std::nth_element(errors.values.begin(), errors.values.begin() + kept - 1, errors.values.end(), less);
  errors.values.resize(static_cast<std::size_t>(kept));
  return mean(errors);
}

std::array<LargestDifference, 3> largest_differences(const Pair& pair, const Window& window) {
  std::array<LargestDifference, 3> largest;
  for (std::size_t c = 0; c < 3; ++c) largest[c] = largest_difference(pair.image[c], pair.reference[c], window);
  return largest;
}

}  // namespace rpf::metrics
