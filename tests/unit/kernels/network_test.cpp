// kernels/rpf_network.h: formulas of the learned estimator against double and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rpf_network.h"
#include "tolerances.h"

namespace rpf::kernel {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

TEST(Log, StaysWithinItsToleranceOfLongDouble) {
  double worst = 0;
  for (int bits = 0x00800000; bits < 0x7f800000; bits += 101) {
    const float x = as_float(bits);
    const auto truth = static_cast<double>(std::log(static_cast<long double>(x)));
    worst = std::max(worst, std::fabs(rpf_log(x) - truth) / std::max(std::fabs(truth), 0.25));
  }
  EXPECT_LE(worst, test::tolerance::log);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Log, OfOneIsExactlyZeroAndGrowsThroughPowersOfTwo) {
  EXPECT_EQ(rpf_log(1.0F), 0.0F);
  for (int e = -125; e < 127; ++e) {
    const float x = std::ldexp(1.0F, e);
    EXPECT_LE(rpf_log(std::nextafter(x, 0.0F)), rpf_log(std::nextafter(x, infinity))) << e;
  }
}

TEST(Exp, IsAsCloseAboveZero) {
  for (int bits = 0; bits <= 0x42b00000; bits += 101) {  // 0 to 88
    const float x = as_float(bits);
    const long double truth = std::exp(static_cast<long double>(x));
    const auto rounded = static_cast<float>(truth);
    const float unit = std::nextafter(rounded, infinity) - rounded;
    ASSERT_LE(static_cast<double>(std::fabs(rpf_exp(x) - truth) / unit), test::tolerance::exp_ulps) << x;
  }
}

TEST(Held, KeepsWhatIsInsideAndTakesTheLowerEndForWhatIsNoNumber) {
  EXPECT_EQ(rpf_held(0.5F, 0, 1), 0.5F);
  EXPECT_EQ(rpf_held(-infinity, 0, 1), 0.0F);
  EXPECT_EQ(rpf_held(infinity, 0, 1), 1.0F);
  EXPECT_EQ(rpf_held(nan, -3, 1), -3.0F);
}

TEST(Seen, ColorsOfAnyRadianceAreFinite) {
  for (const float radiance : {infinity, -infinity, 3e38F, -3e38F, 1e-45F})
    for (const float exposure : {0x1p-126F, 1.0F, 0x1p126F}) {
      const float c = rpf_seen_color(radiance, exposure);
      EXPECT_TRUE(std::isfinite(c * c * 1e9F)) << radiance;
      EXPECT_TRUE(std::isfinite(rpf_brightness(c))) << radiance;
      EXPECT_TRUE(std::isfinite(rpf_brightness_over(c, 0.05F))) << radiance;
    }
  EXPECT_EQ(rpf_brightness(-1.0F), 0.0F);
  EXPECT_NEAR(rpf_brightness(0.25F), std::log(2.0) / 2, test::tolerance::formula);
  EXPECT_NEAR(rpf_brightness_over(0.25F, 0.5F), std::log(2.0) / 2, test::tolerance::formula);
}

TEST(AlbedoBase, IsOneWhereNothingIsHit) {
  EXPECT_EQ(rpf_albedo_base(0.5F, 1), 1.0F);
  EXPECT_EQ(rpf_albedo_base(0.5F, 0), 0.55F);
}

TEST(Moments, AreThoseOfTheSamples) {
  const float first = 1000, values[4] = {1000, 1001, 1003, 1004};  // mean 1002, variance 2.5
  float sum = 0, squares = 0;
  for (const float v : values) {
    sum += v - first;
    squares = fma(v - first, v - first, squares);
  }
  EXPECT_EQ(rpf_shifted_mean(first, sum, 0.25F), 1002.0F);
  EXPECT_EQ(rpf_shifted_variance(sum, squares, 0.25F), 2.5F);
  EXPECT_EQ(rpf_shifted_variance(nan, nan, 0.25F), 0.0F);
  EXPECT_EQ(rpf_shifted_variance(infinity, infinity, 0.25F), 0.0F);
}

TEST(RelativeError, IsQOverOnePlusQ) {
  const double q = std::sqrt(2.0 / 4) / (0.5 + 0.02);
  EXPECT_NEAR(rpf_relative_error(2, 0.5F, 4), q / (1 + q), test::tolerance::formula);
  EXPECT_EQ(rpf_relative_error(0, -1, 4), 0.0F);
}

TEST(Weights, AreFiniteAndAboveZeroWhateverTheNetworkSays) {
  for (const float logit : {nan, infinity, -infinity, 0.0F, 1e30F}) {
    EXPECT_GE(rpf_learned_weight(logit), 3e-4F);
    EXPECT_LE(rpf_learned_weight(logit), 3e3F);
    EXPECT_GE(rpf_own_weight(logit), 3e-4F);
    EXPECT_LE(rpf_bandwidth(logit), 404.0F);
    EXPECT_LE(std::fabs(rpf_embedding(logit)), 1000.0F);
    EXPECT_GE(rpf_blend(logit), 0.0F);
    EXPECT_LE(rpf_blend(logit), 1.0F);
  }
  EXPECT_EQ(rpf_learned_weight(0), 1.0F);
  EXPECT_EQ(rpf_blend(0), 0.5F);
  EXPECT_NEAR(rpf_blend(2), 1 / (1 + std::exp(-2.0)), test::tolerance::formula);
}

TEST(Result, IsNothingWithoutWeightAndPlainWithoutAlbedoNearby) {
  EXPECT_EQ(rpf_over_weight(1, 0), 0.0F);
  EXPECT_EQ(rpf_over_weight(1, 2), 0.5F);
  EXPECT_EQ(rpf_blended(7, 1, 0, 1, 1, 0.5F), 7.0F);
  EXPECT_EQ(rpf_blended(7, 1, 1, 0, 0, 0.5F), 7.0F);
  EXPECT_EQ(rpf_blended(2, 4, 2, 3, 1, 0.5F), 4.0F);  // between 2 and 4 / 2 * 3
}

TEST(Head, HoldsContextBlendAndPasses) {
  EXPECT_EQ(rpf_head_pass(0, 8), 9U);
  EXPECT_EQ(rpf_head_pass(6, 8), 9U + 6 * 19);
}

}  // namespace
}  // namespace rpf::kernel
