// Section 7 on worked examples.
#include <gtest/gtest.h>

#include <vector>

#include "cpu/weighting.h"
#include "tolerances.h"

namespace rpf {
namespace {

double channel_sum(const std::vector<float>& samples, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < samples.size(); i += 3) sum += samples[i];
  return sum;
}

TEST(OutlierStep, ReplacesTheOutlierAndGivesItsEnergyToAll) {
  // R: mean 3, standard deviation sqrt(12): only the 9 is an outlier, it becomes 3; the 6 taken away are 1.5 for each
  // sample.
  std::vector<float> samples = {1, 2, 2, 1, 2, 2, 1, 2, 2, 9, 2, 2};
  replace_outliers(samples.data(), 4, 3);
  const std::vector<float> expected = {2.5F, 2, 2, 2.5F, 2, 2, 2.5F, 2, 2, 4.5F, 2, 2};
  EXPECT_EQ(samples, expected);
}

TEST(OutlierStep, ReplacesAllChannelsOfAnOutlier) {
  std::vector<float> samples = {1, 0, 0, 1, 4, 0, 1, 0, 0, 9, 4, 0};
  replace_outliers(samples.data(), 4, 3);  // G has two equal pairs: nothing is off by more than its deviation of 2
  EXPECT_EQ(samples[9], 4.5F);
  EXPECT_EQ(samples[10], 2.5F);  // mean 2 in place of 4, and the 2 taken away are 0.5 for each
  EXPECT_EQ(samples[1], 0.5F);
}

TEST(OutlierStep, KeepsTwoSamplesAndEqualSamples) {
  const std::vector<float> two = {0.1F, 0.7F, 3, 0.3F, 0.9F, 1},
                           equal = {0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F};
  std::vector<float> samples = two;
  replace_outliers(samples.data(), 2, 3);
  EXPECT_EQ(samples, two);
  samples = equal;
  replace_outliers(samples.data(), 3, 3);
  EXPECT_EQ(samples, equal);
}

// Each half is exactly one deviation off, which rounding of a division by six or ten must not make more.
TEST(OutlierStep, KeepsTwoHalves) {
  for (const int half : {3, 5})
    for (int k = 1; k < 100; ++k) {
      std::vector<float> samples(std::size_t{6} * half, 0.25F);
      for (std::size_t i = samples.size() / 2; i < samples.size(); ++i)
        samples[i] = 0.25F + 0.01F * static_cast<float>(k);
      const std::vector<float> before = samples;
      replace_outliers(samples.data(), 2 * half, 3);
      ASSERT_EQ(samples, before) << half << " samples that are " << k << " hundredths brighter";
    }
}

TEST(OutlierStep, KeepsTheEnergy) {
  std::vector<float> samples;
  for (int i = 0; i < 60; ++i) samples.push_back(static_cast<float>((i * 37 + 11) % 101) * (i == 30 ? 100.0F : 1.0F));
  const std::vector<float> before = samples;
  replace_outliers(samples.data(), 20, 3);
  EXPECT_NE(samples, before);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(channel_sum(samples, c), channel_sum(before, c),
                test::tolerance::outlier_energy * channel_sum(before, c));
}

}  // namespace
}  // namespace rpf
