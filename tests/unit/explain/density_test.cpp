// How many samples each pixel should get next.
#include "rpf/density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "rpf/error.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::defocused_edge;

/// A flat picture, noisy in its right half only.
SampleBuffer half_noisy() {
  SampleBuffer samples = defocused_edge({30, 12, 4, 3});
  test::Dice dice(5);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    const bool noisy = i / 4 % 30 >= 15;
    for (const char* slot : {"R", "G", "B"}) test::value_of(samples, i, slot) = noisy ? dice() : 0.5F;
  }
  return samples;
}

double sum_of(const Image& image) { return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0); }

TEST(Density, HasWholeNumbersFromOneAndAnExactMean) {
  for (const int count : {0, 2, 4})
    for (const int samples : {1, 4, 7}) {
      const Image density = sample_density(defocused_edge({17, 9, count, 2}), samples);
      ASSERT_EQ(density.channels, std::vector<std::string>{"Y"});
      ASSERT_EQ(density.pixels.size(), 17U * 9U);
      for (const float value : density.pixels) {
        ASSERT_GE(value, 1);
        ASSERT_EQ(value, std::floor(value));
      }
      EXPECT_EQ(sum_of(density), 17 * 9 * samples);
    }
}

TEST(Density, GoesToTheNoise) {
  const Image density = sample_density(half_noisy(), 4);
  double noisy = 0;
  for (int y = 0; y < 12; ++y) {
    EXPECT_EQ(density.pixels[static_cast<std::size_t>(y) * 30 + 5], 1);
    EXPECT_GE(density.pixels[static_cast<std::size_t>(y) * 30 + 25], 4);
    noisy += density.pixels[static_cast<std::size_t>(y) * 30 + 25];
  }
  EXPECT_GE(noisy / 12, 6);  // 7, where all of the flat half gets 1
}

TEST(Density, GivesWhatIsAlikeTheSame) {
  SampleBuffer samples = defocused_edge({11, 7, 4, 2});
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.25F);
  for (const float value : sample_density(samples, 3).pixels) EXPECT_EQ(value, 3);
}

TEST(Density, DoesNotCountValuesThatAreNone) {
  SampleBuffer samples = half_noisy();
  test::value_of(samples, 20, "R") = std::numeric_limits<float>::quiet_NaN();
  test::value_of(samples, 21, "G") = std::numeric_limits<float>::infinity();
  EXPECT_EQ(sum_of(sample_density(samples, 4)), 30 * 12 * 4);
}

TEST(Density, TellsTheErrorOfThePlainMean) {
  const double variance = 1 / 12.0, brightness = 0.5 * 0.5 + 0.01;  // of uniform numbers, which half of the pixels are
  const double expected = variance / 4 / brightness / 2;
  EXPECT_NEAR(mean_error(half_noisy()), expected, test::tolerance::estimated_error * expected);
}

/// The features of a method that leaves an error of 1 in the right half, and of `left` in the left one.
Image error_of_method(float left) {
  Image image;
  image.data_window = image.display_window = {0, 0, 30, 12};
  image.channels = {"albedo.R", "error"};
  for (int p = 0; p < 30 * 12; ++p) image.pixels.insert(image.pixels.end(), {7.0F, p % 30 < 15 ? left : 1.0F});
  return image;
}

TEST(Density, GoesToWhatAMethodLeaves) {
  SampleBuffer samples = half_noisy();
  test::Dice dice(6);  // all noisy alike
  for (float* record = samples.values.data(); record < samples.values.data() + samples.values.size();
       record += samples.layout.size())
    for (const char* slot : {"R", "G", "B"}) record[*samples.layout.find(slot)] = dice();
  const Image density = sample_density(samples, 12, error_of_method(0.25F));
  EXPECT_EQ(sum_of(density), 30 * 12 * 12);
  double right = 0;
  for (std::size_t p = 0; p < density.pixels.size(); ++p) right += p % 30 < 15 ? 0 : density.pixels[p] + 4;
  EXPECT_NEAR(right / (30 * 12 * 16), 2 / 3.0, 0.02);  // totals as the root of 0.25 to 1
}

TEST(Density, RefusesAnEstimateOfSomethingElse) {
  Image other = error_of_method(1);
  other.channels = {"albedo.R", "albedo.G"};
  EXPECT_THROW(sample_density(half_noisy(), 4, other), Error);
  other = error_of_method(1);
  other.data_window.x = 1;
  EXPECT_THROW(sample_density(half_noisy(), 4, other), Error);
}

TEST(Density, RefusesWhatItCannotTell) {
  EXPECT_THROW(mean_error(defocused_edge({9, 7, 1, 2})), Error);
  EXPECT_THROW(sample_density(defocused_edge({9, 7, 1, 2}), 4), Error);
  EXPECT_THROW(sample_density(defocused_edge(), 0), Error);
}

TEST(Density, RefusesAnEstimateThatIsNone) {
  const SampleBuffer samples = half_noisy();
  Image estimate;
  estimate.data_window = samples.data_window;
  estimate.channels = {"error"};
  estimate.pixels.assign(samples.data_window.pixel_count(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_THROW(sample_density(samples, 4, estimate), Error);
  estimate.pixels[0] = 0.1F;
  EXPECT_NO_THROW(sample_density(samples, 4, estimate));
  estimate.pixels[1] = -0.1F;
  EXPECT_THROW(sample_density(samples, 4, estimate), Error);
}

}  // namespace
}  // namespace rpf
