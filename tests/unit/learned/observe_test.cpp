// What the learned estimator is shown of a frame, against docs/network.md.
#include "learned/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test_frames.h"
#include "test_networks.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::value_of;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

struct Seen : Observed {
  /// 0 where it has no column.
  float input(std::size_t sample, int number) const {
    const int column = plan.column[static_cast<std::size_t>(number)];
    return column < 0 ? 0 : prepared.frame.record(sample)[column];
  }
};

Seen observed(SampleBuffer samples, Settings settings = {}) {
  settings.method = Method::learned;
  return {observe(std::move(samples), settings, std::make_shared<Network>(test::random_network()))};
}

/// Two pixels of two samples each, everything the same.
SampleBuffer two_pixels() {
  SampleBuffer samples = test::every_input({2, 1, 2, 1});
  for (std::size_t i = 0; i < 4; ++i)
    for (const std::string& slot : samples.layout.slots)
      value_of(samples, i, slot) = slot == "film.X" ? static_cast<float>(i / 2) + 0.5F : 0.5F;
  return samples;
}

TEST(Exposure, BringsTheMeanLuminanceBetweenAQuarterAndAHalf) {
  for (const float radiance : {1e-20F, 0.1F, 1.0F, 3.0F, 1e20F}) {
    SampleBuffer samples = two_pixels();
    for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, radiance);
    const Seen o = observed(samples);
    const float seen = o.prepared.frame.record(0)[0] * o.plan.exposure;
    EXPECT_GE(seen, 0.25F) << radiance;
    EXPECT_LT(seen, 0.5F) << radiance;
  }
}

/// Of a row of pixels, one sample each.
float exposure_of_row(const std::vector<float>& radiance) {
  SampleBuffer samples = test::every_input({static_cast<int>(radiance.size()), 1, 1, 1});
  for (std::size_t i = 0; i < radiance.size(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = radiance[i];
  const Seen o = observed(samples);
  return o.plan.exposure * o.prepared.facts.radiance_scale;
}

TEST(Exposure, TakesABlockForEightTimesTheMedianAtMost) {
  std::vector<float> row(24, 1.0F);
  std::fill(row.begin() + 16, row.end(), 1000.0F);  // counts as 8: the mean is 10/3
  EXPECT_EQ(exposure_of_row(row), 0.125F);
}

TEST(Exposure, CountsABlockAtTheEdgeByItsPixels) {
  std::vector<float> row(9, 1.0F);
  row[8] = 1000;  // counts as 8: the mean is 16/9, of blocks it would be 9/2
  EXPECT_EQ(exposure_of_row(row), 0.25F);
}

TEST(Exposure, OfFewSamplesThatCarryTheLightIsThatOfTheirMean) {
  std::vector<float> row(64, 0.01F);
  for (std::size_t i = 3; i < row.size(); i += 8) row[i] = 9;  // the median of the pixels is 0.01, the mean 1.13
  EXPECT_EQ(exposure_of_row(row), exposure_of_row(std::vector<float>(64, 1.13F)));
}

TEST(Exposure, OfABlackFrameIsOne) {
  SampleBuffer samples = two_pixels();
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0);
  EXPECT_EQ(observed(samples).plan.exposure, 1.0F);
}

TEST(Inputs, OfAFrameThatIsTheSameEverywhereAreNone) {
  const Seen o = observed(two_pixels());
  EXPECT_THAT(o.plan.live, testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(o.plan.has_albedo);
  EXPECT_EQ(o.input(0, RPF_INPUT_ALBEDO), 0.5F);  // a needs it
  EXPECT_EQ(o.prepared.frame.variables, 6U);
}

TEST(Inputs, OfRandomNumbersAreTwiceTheirDistanceToOneHalf) {
  SampleBuffer samples = two_pixels();
  value_of(samples, 1, "random.lens.V") = 0.75F;
  value_of(samples, 1, "random.time") = 0;
  value_of(samples, 2, "film.X") = 1.125F;
  const Seen o = observed(samples);
  EXPECT_THAT(o.plan.live, testing::ElementsAre(0, 1, 2, 3, 4, 5, RPF_INPUT_LENS + 1, RPF_INPUT_TIME, RPF_INPUT_FILM));
  EXPECT_EQ(o.input(1, RPF_INPUT_LENS + 1), 0.5F);
  EXPECT_EQ(o.input(1, RPF_INPUT_TIME), -1.0F);
  EXPECT_EQ(o.input(2, RPF_INPUT_FILM), -0.75F);
  EXPECT_THAT(o.prepared.facts.variables.random_names, testing::ElementsAre("lens.V", "time"));
}

TEST(Inputs, OfPositionsAreRelativeToMedianAndDeviation) {
  SampleBuffer samples = test::every_input({5, 1, 1, 1});
  const float x[] = {1, 2, 3, 4, 100};  // median 3; deviations 2 1 0 1 97, of all three components 101 / 15
  for (std::size_t i = 0; i < 5; ++i) {
    for (const char* slot : {"feature.hit", "feature.P.Y", "feature.P.Z", "feature.P2.Y", "feature.P2.Z"})
      value_of(samples, i, slot) = 1;
    value_of(samples, i, "feature.P.X") = x[i];
    value_of(samples, i, "feature.P2.X") = x[i] + 5;
    value_of(samples, i, "feature.N2.X") = i == 2 ? 0.0F : 1.0F;
    value_of(samples, i, "feature.N2.Y") = value_of(samples, i, "feature.N2.Z") = 0;
  }
  const double d = 101.0 / 15;
  const Seen o = observed(samples);
  EXPECT_NEAR(o.input(0, RPF_INPUT_POSITION), -2 / d, test::tolerance::formula);
  EXPECT_EQ(o.input(4, RPF_INPUT_POSITION), 4.0F);
  EXPECT_NEAR(o.input(0, RPF_INPUT_DISTANCE2), std::log(1 + 4 * 5 / d), test::tolerance::formula);
  EXPECT_EQ(o.input(2, RPF_INPUT_DISTANCE2), 0.0F);  // no second hit
  EXPECT_EQ(o.input(2, RPF_INPUT_HIT2), 0.0F);
  EXPECT_EQ(o.input(1, RPF_INPUT_HIT2), 1.0F);
  EXPECT_FALSE(o.plan.is_live(RPF_INPUT_POSITION + 1));
}

TEST(Inputs, OfAMissedRayAndOfMissingValuesAreZero) {
  SampleBuffer samples = test::every_input({4, 4, 2, 1});
  for (const std::string& slot : samples.layout.slots)
    if (is_feature_slot(slot) || is_random_slot(slot)) value_of(samples, 3, slot) = missing;
  value_of(samples, 3, "feature.hit") = 0;
  value_of(samples, 0, "feature.N.Y") = 0.5F;  // of the others 0
  const Seen o = observed(samples);
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input) {
    if (input == RPF_INPUT_FILM || input == RPF_INPUT_FILM + 1) continue;
    EXPECT_TRUE(o.plan.is_live(input)) << input;
    EXPECT_EQ(o.input(3, input), input == RPF_INPUT_MISS ? 1.0F : 0.0F) << input;
  }
}

TEST(Inputs, OfAMissAreFoundByTheNormalWithoutAHitChannel) {
  SampleBuffer samples = test::defocused_edge({4, 4, 2, 1});
  for (const char* slot : {"feature.N.X", "feature.N.Y", "feature.N.Z"}) value_of(samples, 1, slot) = 0;
  value_of(samples, 2, "feature.N.Y") = missing;
  const Seen o = observed(samples);
  EXPECT_EQ(o.input(0, RPF_INPUT_MISS), 0.0F);
  EXPECT_EQ(o.input(1, RPF_INPUT_MISS), 1.0F);
  EXPECT_EQ(o.input(2, RPF_INPUT_MISS), 1.0F);
  EXPECT_EQ(o.input(1, RPF_INPUT_POSITION), 0.0F);
}

TEST(Inputs, OfAnIncompleteGroupAreAbsent) {
  const Seen o = observed(test::defocused_edge({4, 4, 2, 1}));  // albedo.R alone
  EXPECT_FALSE(o.plan.has_albedo);
  EXPECT_EQ(o.plan.column[RPF_INPUT_ALBEDO], -1);
  EXPECT_THAT(o.prepared.dropped, testing::Contains("albedo.R"));
}

TEST(Inputs, AreThoseOfTheSettingsGroups) {
  Settings settings;
  settings.features = std::vector<std::string>{"albedo"};
  settings.random = std::vector<std::string>{};
  const Seen o = observed(test::every_input({4, 4, 2, 1}), settings);
  for (const int input : o.plan.live)
    EXPECT_TRUE(input < 6 || (input >= RPF_INPUT_ALBEDO && input < RPF_INPUT_ALBEDO + 3) || input == RPF_INPUT_MISS ||
                input == RPF_INPUT_FILM || input == RPF_INPUT_FILM + 1)
        << input;
}

TEST(Inputs, AreFiniteForTheLargestValuesThereAre) {
  SampleBuffer samples = test::every_input({4, 4, 2, 1});
  for (const std::string& slot : samples.layout.slots)
    if (is_feature_slot(slot) || is_random_slot(slot)) value_of(samples, 3, slot) = slot.back() == 'Y' ? -1e15F : 1e15F;
  const Seen o = observed(samples);
  for (const float v : o.prepared.frame.records) EXPECT_TRUE(std::isfinite(v));
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input) EXPECT_LE(std::fabs(o.input(3, input)), 40.0F);
}

TEST(Energy, IsThatOfTheMeansInTheCrop) {
  SampleBuffer samples = two_pixels();
  for (const char* slot : {"R", "G", "B"})
    for (std::size_t i = 0; i < 4; ++i) value_of(samples, i, slot) = static_cast<float>(i + 1);  // 1 2, 3 4
  const auto energy_of = [](const SampleBuffer& frame, const Settings& settings) {
    const Seen o = observed(frame, settings);
    return o.energy / o.prepared.facts.radiance_scale;
  };
  EXPECT_DOUBLE_EQ(energy_of(samples, {}), 3 * (1.5 + 3.5));
  Settings second;
  second.crop = Window{1, 0, 1, 1};
  EXPECT_DOUBLE_EQ(energy_of(samples, second), 3 * 3.5);
  test::add_channel(samples, "weight", 1);
  value_of(samples, 3, "weight") = 3;
  EXPECT_DOUBLE_EQ(energy_of(samples, second), 3 * 3.75);
}

TEST(WeightScale, BringsTheLargestWeightBetweenOneAndTwo) {
  SampleBuffer samples = two_pixels();
  test::add_channel(samples, "weight", 1e-3F);
  value_of(samples, 2, "weight") = 1e10F;
  const Seen o = observed(samples);
  EXPECT_GE(1e10F * o.plan.weight_scale, 1.0F);
  EXPECT_LT(1e10F * o.plan.weight_scale, 2.0F);
}

}  // namespace
}  // namespace rpf
