#include "metrics/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/flip.h"

namespace rpf::metrics {
namespace {

/// Narkowicz's fit of the ACES tone curve, (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5), with its built-in exposure of 0.6
/// taken out.
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;

double tone_mapped(double light) {
  constexpr double white = 1e9;  // far above all that the curve tells from white: no infinity over infinity
  const double x = std::clamp(light, 0.0, white);
  return std::min((k0 * x + k1) * x / ((k3 * x + k4) * x + k5), 1.0);
}

/// The light that the curve shows at 0.85: the positive root of a x^2 + b x + c.
double nearly_white() {
  constexpr double shown = 0.85;
  constexpr double a = k0 - shown * k3, b = k1 - shown * k4, c = -shown * k5;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

std::vector<double> luminances_of(const ColorPlanes& color) {
  std::vector<double> luminances;
  luminances.reserve(color[0].values.size());
  for (std::size_t i = 0; i < color[0].values.size(); ++i) {
    const double y = 0.2126 * color[0].values[i] + 0.7152 * color[1].values[i] + 0.0722 * color[2].values[i];
    if (std::isfinite(y)) luminances.push_back(y);
  }
  return luminances;
}

ColorPlanes exposed(const ColorPlanes& color, double exposure) {
  const double factor = std::exp2(exposure);
  ColorPlanes result = color;
  for (Plane& plane : result) plane = mapped(std::move(plane), [&](double v) { return tone_mapped(factor * v); });
  return result;
}

}  // namespace

ExposureRange exposure_range(const ColorPlanes& reference) {
  constexpr double black = std::numeric_limits<float>::epsilon();  // the authors' least median
  std::vector<double> luminances = luminances_of(reference);
  if (luminances.empty()) luminances = {black};
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double brightest = *std::max_element(middle, luminances.end());
  ExposureRange range;
  range.first = std::log2(nearly_white() / std::max(brightest, black));
  range.last = std::log2(nearly_white() / std::max(*middle, black));
  range.count = std::max(2, static_cast<int>(std::ceil(range.last - range.first)));
  return range;
}

Plane hdr_flip_map(const Pair& light) {
  const ExposureRange range = exposure_range(light.reference);
  const double step = (range.last - range.first) / (range.count - 1);
  Plane worst;
  for (int i = 0; i < range.count; ++i) {
    const double exposure = range.first + i * step;
    Plane errors = flip_map({exposed(light.image, exposure), exposed(light.reference, exposure)});
    // A NaN is one at every exposure, and std::max keeps it where it stands first.
    worst = i == 0 ? std::move(errors)
                   : combined(std::move(worst), errors, [](double a, double b) { return std::max(a, b); });
  }
  return worst;
}

}  // namespace rpf::metrics
