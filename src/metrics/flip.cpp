#include "metrics/flip.h"

#include <algorithm>
#include <cmath>

#include "metrics/convolution.h"
#include "metrics/flip_color.h"

namespace rpf::metrics {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double pixels_per_degree = 3840 * pi / 180;  ///< 0.7 m * (3840 pixels / 0.7 m) * pi / 180

// ---- planes of colors

Triple pixel(const ColorPlanes& color, std::size_t i) {
  return {color[0].values[i], color[1].values[i], color[2].values[i]};
}

template <class Function>
ColorPlanes converted(const ColorPlanes& color, Function function) {
  ColorPlanes result = color;
  for (std::size_t i = 0; i < color[0].values.size(); ++i) {
    const Triple value = function(pixel(color, i));
    for (std::size_t c = 0; c < 3; ++c) result[c].values[i] = value[c];
  }
  return result;
}

// ---- the color pipeline: what the eye resolves at that distance, compared as color (paper, sections 4.1.1 to 4.1.3)

/// A Gaussian of the eye's contrast sensitivity in pixels, separated: its square is a sqrt(pi/b) exp(-pi^2 x^2 / b)
/// at x = 0, with x in degrees.
Weights sensitivity(double a, double b) {
  constexpr double widest = 0.04;  // the largest b of all channels sets the radius of all
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
  return scaled(gaussian(std::sqrt(b / 2) / pi * pixels_per_degree, radius), std::sqrt(a * std::sqrt(pi / b)));
}

Plane blurred(const Plane& plane, double b) {
  Weights weights = sensitivity(1, b);
  weights = scaled(weights, 1 / sum(weights));
  return convolve(plane, weights, weights);
}

/// Blue-yellow is seen through a sum of two Gaussians.
Plane blurred_blue_yellow(const Plane& plane) {
  const Weights narrow = sensitivity(34.1, 0.04), wide = sensitivity(13.5, 0.025);
  const double total = std::pow(sum(narrow), 2) + std::pow(sum(wide), 2);
  return combined(convolve(plane, narrow, narrow), convolve(plane, wide, wide),
                  [total](double a, double b) { return (a + b) / total; });
}

ColorPlanes seen(const ColorPlanes& opponent) {
  const ColorPlanes blurred_color{blurred(opponent[0], 0.0047), blurred(opponent[1], 0.0053),
                                  blurred_blue_yellow(opponent[2])};
  return converted(blurred_color, [](const Triple& value) {
    Triple rgb = rgb_of(value);
    for (double& light : rgb) light = std::clamp(light, 0.0, 1.0);
    return hunt_lab_of(rgb);
  });
}

/// Distances up to 0.4 of the largest, that of green and blue, take [0, 0.95], the rare larger ones the rest.
double compressed(double distance) {
  static const double largest = hyab_distance(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1}));
  const double knee = 0.4 * largest;
  return distance < knee ? distance * 0.95 / knee : 0.95 + (distance - knee) / (largest - knee) * 0.05;
}

Plane color_difference(const ColorPlanes& image, const ColorPlanes& reference) {
  const ColorPlanes a = seen(image), b = seen(reference);
  Plane result = a[0];
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = compressed(hyab_distance(pixel(a, i), pixel(b, i)));
  return result;
}

// ---- the feature pipeline: edges and points of the achromatic channel (paper, section 4.2)

/// Positive weights sum to 1, negative ones to -1.
Weights balanced(Weights weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : weights) w /= w > 0 ? positive : negative;
  return weights;
}

/// Magnitudes of the first and of the second derivatives.
struct Features {
  Plane edges, points;
};

Features features_of(const Plane& luminance) {
  constexpr double sigma = 0.5 * 0.082 * pixels_per_degree;  // an edge is 0.082 degrees wide
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Weights bell = gaussian(sigma, radius);
  Weights first = bell, second = bell;
  for (std::size_t i = 0; i < bell.size(); ++i) {
    const double x = static_cast<double>(i) - radius;
    first[i] *= -x;
    second[i] *= x * x / (sigma * sigma) - 1;
  }
  const Weights smooth = scaled(bell, 1 / sum(bell));
  const auto magnitude = [&](const Weights& derivative) {
    return combined(convolve(luminance, derivative, smooth), convolve(luminance, smooth, derivative),
                    [](double x, double y) { return std::hypot(x, y); });
  };
  return {magnitude(balanced(first)), magnitude(balanced(second))};
}

Plane feature_difference(const Plane& image, const Plane& reference) {
  const auto light = [](double y) { return (y + 16) / 116; };
  const Features a = features_of(mapped(image, light)), b = features_of(mapped(reference, light));
  const auto distance = [](double p, double q) { return std::abs(p - q); };
  return combined(combined(a.edges, b.edges, distance), combined(a.points, b.points, distance),
                  [](double edge, double point) { return std::sqrt(std::max(edge, point) / std::sqrt(2.0)); });
}

}  // namespace

Plane flip_map(const Pair& light) {
  const ColorPlanes image = converted(light.image, opponent_of), reference = converted(light.reference, opponent_of);
  return combined(color_difference(image, reference), feature_difference(image[0], reference[0]),
                  [](double color, double feature) { return std::pow(color, 1 - feature); });
}

}  // namespace rpf::metrics
