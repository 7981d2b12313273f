#include "metrics/structural_similarity.h"

#include <limits>

#include "metrics/convolution.h"

namespace rpf::metrics {
namespace {

constexpr int radius = 5;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  ///< (K1 L)^2 and (K2 L)^2 with the peak L = 1

/// The weighted moments of two planes in the window of every pixel.
struct Moments {
  Plane mean_a, mean_b, aa, bb, ab;
};

Moments moments_of(const Plane& a, const Plane& b) {
  Weights window = gaussian(sigma, radius);
  window = scaled(window, 1 / sum(window));
  const auto windowed = [&](const Plane& plane) { return convolve(plane, window, window); };
  const auto product = [&](const Plane& p, const Plane& q) { return windowed(combined(p, q, std::multiplies<>())); };
  return {windowed(a), windowed(b), product(a, a), product(b, b), product(a, b)};
}

double similarity(const Moments& m, int x, int y) {
  const double a = m.mean_a.at(x, y), b = m.mean_b.at(x, y);
  const double variance_a = m.aa.at(x, y) - a * a, variance_b = m.bb.at(x, y) - b * b;
  const double covariance = m.ab.at(x, y) - a * b;
  return (2 * a * b + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variance_a + variance_b + c2));
}

double mean_similarity(const Plane& a, const Plane& b) {
  const Moments moments = moments_of(a, b);
  double total = 0;
  for (int y = radius; y < a.height - radius; ++y)
    for (int x = radius; x < a.width - radius; ++x) total += similarity(moments, x, y);
  return total / (static_cast<double>(a.width - 2 * radius) * (a.height - 2 * radius));
}

}  // namespace

double structural_similarity(const Pair& shown) {
  const Plane& size = shown.reference[0];
  if (size.width <= 2 * radius || size.height <= 2 * radius) return std::numeric_limits<double>::quiet_NaN();
  double total = 0;
  for (std::size_t c = 0; c < 3; ++c) total += mean_similarity(shown.image[c], shown.reference[c]);
  return total / 3;
}

}  // namespace rpf::metrics
