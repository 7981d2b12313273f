// kernels/rpf_math.h: the formulas, against values worked out by hand from docs/algorithm.md.
#include "rpf_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tolerances.h"

namespace rpf::kernel {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

TEST(Tolerance, IsTheLargerOfScaledDeviationAndMinimum) {
  EXPECT_EQ(rpf_tolerance(3, 0.5F, 0.1F), 1.5F);
  EXPECT_EQ(rpf_tolerance(3, 0.01F, 0.1F), 0.1F);
  EXPECT_EQ(rpf_tolerance(30, 5, infinity), infinity);
}

TEST(Rejection, IsStrictAbsoluteAndIgnoresMissingValues) {
  EXPECT_FALSE(rpf_rejects(1.5F, 1.0F, 0.5F));
  EXPECT_TRUE(rpf_rejects(1.5001F, 1.0F, 0.5F));
  EXPECT_TRUE(rpf_rejects(0.4999F, 1.0F, 0.5F));
  EXPECT_FALSE(rpf_rejects(missing, 1.0F, 0.5F));
  EXPECT_FALSE(rpf_rejects(1e9F, 1.0F, infinity));
}

TEST(Normalization, TreatsTinySpreadAsConstant) {
  EXPECT_EQ(rpf_inverse_deviation(4.0F, 10.0F), 0.5F);
  EXPECT_EQ(rpf_inverse_deviation(0.0F, 0.0F), 0.0F);
  EXPECT_EQ(rpf_inverse_deviation(1e-14F, 1.0F), 0.0F);
  EXPECT_GT(rpf_inverse_deviation(1e-10F, 1.0F), 0.0F);
  EXPECT_TRUE(rpf_is_missing(rpf_normalize(missing, 1.0F, 2.0F)));
  EXPECT_EQ(rpf_normalize(5.0F, 1.0F, 0.5F), 2.0F);
}

TEST(Bin, RoundsHalfAwayFromZeroAndClamps) {
  const struct {
    float value;
    int bin;
  } cases[] = {{0, 3},     {0.5F, 4},        {-0.5F, 2},        {1.5F, 5},       {-1.5F, 1}, {2.5F, 6},
               {-2.5F, 0}, {0.49999997F, 3}, {-0.49999997F, 3}, {2.4999998F, 5}, {1e30F, 6}, {-infinity, 0}};
  for (const auto& c : cases) EXPECT_EQ(rpf_bin(c.value, 3), c.bin) << c.value;
}

TEST(MutualInformation, CountsWhatCannotBeToldFromZeroAsZero) {
  EXPECT_EQ(rpf_mutual_information(-5, 32, 1, 0, 10), 0.0F);
  EXPECT_EQ(rpf_mutual_information(32, 32, 1, 0, 10), 0.0F);
  EXPECT_EQ(rpf_mutual_information(40, 32, 0.5F, 0, 10), 2.0F);
  EXPECT_EQ(rpf_mutual_information(40, 32, 0.5F, 18, 10), 0.2F);
  EXPECT_EQ(rpf_mutual_information(40, 32, 0.5F, 30, 10), 0.0F);
}

TEST(Fractions, AreDefinedWithoutAnyDependence) {
  EXPECT_EQ(rpf_fraction_random(0, 0), 0.0F);
  EXPECT_EQ(rpf_fraction_feature(0, 0, 0, 0), 0.0F);
  EXPECT_NEAR(rpf_fraction_random(3, 1), 0.75, test::tolerance::formula);
  EXPECT_NEAR(rpf_fraction_feature(1, 1, 2, 1), 0.25, test::tolerance::formula);
}

TEST(AlphaAndBeta, FollowEquation59) {
  EXPECT_NEAR(rpf_alpha(2, 1.1F, 0.25F), 1 - 2 * 1.1 * 0.25, test::tolerance::formula);
  EXPECT_EQ(rpf_alpha(2, 1, 0.5F), 0.0F);
  EXPECT_EQ(rpf_alpha(2, 1, 0.9F), 0.0F);
  EXPECT_NEAR(rpf_beta(0.5F, 1.2F, 0.25F), 0.5 * (1 - 1.2 * 0.25), test::tolerance::formula);
  EXPECT_EQ(rpf_beta(0.5F, 1.3F, 0.9F), 0.0F);
}

TEST(Weight, FollowsEquations53And510) {
  // sigma^2 = 8 * 0.02 / 4 = 0.04; exponent = (1 - 0.25)^2 / (2 * 0.04) * alpha * distance^2
  const float sharpness = rpf_sharpness(0.25F, 0.02F, 4);
  EXPECT_NEAR(sharpness, 0.75 * 0.75 / 0.08, 1e-5);
  const float scaled = rpf_distance_scale(sharpness, 0.3F) * 0.2F;
  EXPECT_NEAR(rpf_weight(scaled * scaled), std::exp(-0.75 * 0.75 / 0.08 * 0.3 * 0.04), test::tolerance::formula);
  EXPECT_EQ(rpf_sharpness(1.0F, 0.02F, 4), 0.0F);
  EXPECT_EQ(rpf_weight(0), 1.0F);
}

TEST(Filtered, CannotLeaveTheHull) {
  EXPECT_EQ(rpf_filtered(1.0F, 2.0F, 0.0F, 1.0F), 0.5F);
  EXPECT_EQ(rpf_filtered(2.0F, 1.0F, 0.0F, 1.5F), 1.5F);
  EXPECT_EQ(rpf_filtered(0.1F, 1.0F, 0.2F, 1.5F), 0.2F);
}

TEST(Outlier, IsMoreThanOneStandardDeviationOff) {
  EXPECT_FALSE(rpf_is_outlier(2.0F, 1.0F, 1.0F));
  EXPECT_TRUE(rpf_is_outlier(2.001F, 1.0F, 1.0F));
  EXPECT_TRUE(rpf_is_outlier(-0.001F, 1.0F, 1.0F));
}

TEST(Draws, DifferBetweenPassesSeedsPixelsAndAttempts) {
  const rpf_words key = rpf_draw_key(1, 0, 5);
  const uint first = rpf_draw_words(key, 0, 0).x;
  EXPECT_NE(first, rpf_draw_words(key, 0, 1).x);
  EXPECT_NE(first, rpf_draw_words(key, 1, 0).x);
  EXPECT_NE(first, rpf_draw_words(rpf_draw_key(1, 1, 5), 0, 0).x);
  EXPECT_NE(first, rpf_draw_words(rpf_draw_key(2, 0, 5), 0, 0).x);
  EXPECT_NE(first, rpf_draw_words(rpf_draw_key(1, 0, 6), 0, 0).x);
  for (const uint count : {1U, 3U, 1000U}) {
    EXPECT_EQ(rpf_choose(0, count), 0U);
    EXPECT_EQ(rpf_choose(0xFFFFFFFFU, count), count - 1);
  }
}

}  // namespace
}  // namespace rpf::kernel
