// The scene dof-edge against its closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rpf/scene.h"

namespace {

// src/scene/scenes_defocus.cpp: near half-plane x < 0 at distance 2, far plane at 8, sharp at 4, lens radius 0.4; the
// frame is as wide as its distance.
constexpr double focus = 4, lens_radius = 0.4;
constexpr double near_color[] = {0.75, 0.375, 0.125}, far_color[] = {0.125, 0.25, 0.625};

/// Integral from -1 to a of the part of the unit disc with x below the variable: of
/// F(a) = 1/2 + (a sqrt(1 - a^2) + asin a) / pi.
double integral_of_disc_part(double a) {
  if (a <= -1) return 0;
  if (a >= 1) return a;
  const double root = std::sqrt(1 - a * a);
  return a / 2 + (a * std::asin(a) + root - root * root * root / 3) / M_PI;
}

/// The part of a pixel's rays that the near plane stops. A ray through the lens at x = l and the plane of focus at
/// x = f is at (l + f) / 2 when it has gone half of the way, so it is stopped where l < -f.
double near_part(int x, int width) {
  const double left = focus * (static_cast<double>(x) / width - 0.5), right = left + focus / width;
  const double a = -right / lens_radius, b = -left / lens_radius;
  return (integral_of_disc_part(b) - integral_of_disc_part(a)) / (b - a);
}

class DofEdge : public testing::TestWithParam<rpf::SceneSampler> {};

TEST_P(DofEdge, EqualsItsClosedFormWithinThreeStandardErrors) {
  rpf::SceneOptions options;
  options.width = 120;
  options.height = 1;
  options.samples = 65536;
  options.sampler = GetParam();
  const rpf::Image image = render_reference("dof-edge", options);
  int blurred = 0;
  for (int x = 0; x < options.width; ++x) {
    const double p = near_part(x, options.width);
    const double deviation = std::sqrt(std::max(p * (1 - p), 0.0) / options.samples);
    if (p > 1e-3 && p < 1 - 1e-3) ++blurred;
    for (int c = 0; c < 3; ++c) {
      const double expected = p * near_color[c] + (1 - p) * far_color[c];
      const double rounding = 1e-7;
      EXPECT_NEAR(image.pixel(x)[c], expected, 3 * deviation * std::fabs(near_color[c] - far_color[c]) + rounding)
          << "pixel " << x << ", channel " << c;
    }
  }
  EXPECT_GT(blurred, 20);
}

INSTANTIATE_TEST_SUITE_P(Samplers, DofEdge,
                         testing::Values(rpf::SceneSampler::random, rpf::SceneSampler::stratified,
                                         rpf::SceneSampler::sobol));

}  // namespace
