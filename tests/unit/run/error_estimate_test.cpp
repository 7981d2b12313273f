// How wrong a filtered frame says that it is.
#include <gtest/gtest.h>

#include <cmath>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

constexpr int width = 40, height = 30;
constexpr double least_brightness = 0.01;

/// Samples in the middle of their pixels, with what `color` says for a column.
template <class Color>
SampleBuffer picture_of(int samples, const Color& color) {
  SampleBuffer frame = test::defocused_edge({width, height, samples, 3});
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    const std::size_t pixel = i / static_cast<std::size_t>(samples);
    for (const char* slot : {"R", "G", "B"}) test::value_of(frame, i, slot) = color(pixel % width);
    test::value_of(frame, i, "film.X") = static_cast<float>(pixel % width) + 0.5F;
    test::value_of(frame, i, "film.Y") = static_cast<float>(pixel / width) + 0.5F;
  }
  return frame;
}

Settings gaussian(int box) {
  Settings settings = method_settings("gaussian");
  settings.backend = test::backend_under_test();
  settings.box_widths = {box};
  settings.threads = 1;
  settings.estimate_error = true;
  return settings;
}

double relative(double a, double b) { return (a - b) * (a - b) / (a * a + least_brightness); }

TEST(Filter, TellsAnErrorThatIsNoise) {
  test::Dice dice(7);
  const Result result = filter(picture_of(8, [&](std::size_t) { return 0.5F + dice(); }), gaussian(5));
  ASSERT_EQ(result.features.channels, std::vector<std::string>{"error"});
  double estimated = 0, real = 0;
  for (std::size_t p = 0; p < result.image.data_window.pixel_count(); ++p) {
    estimated += std::pow(*result.features.pixel(p), 2);
    for (int c = 0; c < 3; ++c) real += relative(result.image.pixel(p)[c], 1) / 3;
  }
  EXPECT_NEAR(estimated / real, 1, test::tolerance::noise_of_halves);
}

/// Without noise nothing but the filter's blur is wrong, and it is the same in both halves.
TEST(Filter, TellsAnErrorThatIsBlur) {
  const auto step = [](std::size_t x) { return x < width / 2 ? 0.25F : 1.0F; };
  const Result result = filter(picture_of(2, step), gaussian(11));
  constexpr int around = 4;
  for (int x = 0; x < width; ++x) {
    double sum = 0, squares = 0, count = 0;
    for (int i = std::max(x - around, 0); i <= std::min(x + around, width - 1); ++i) {
      const double wrong =
          relative(*result.image.pixel(static_cast<std::size_t>(i) + 10 * width), step(static_cast<std::size_t>(i)));
      constexpr int rows = 2 * around + 1;  // which are alike
      sum += rows * wrong;
      squares += rows * wrong * wrong;
      count += rows;
    }
    const double mean = sum / count, chance = (squares / count - mean * mean) / (count - 1);
    const double expected = mean > 0 ? std::sqrt(std::max(mean - chance / mean, 0.0)) : 0;
    EXPECT_NEAR(*result.features.pixel(static_cast<std::size_t>(x) + 10 * width), expected, test::tolerance::formula);
  }
}

TEST(Filter, GivesTheSamePictureWhereItTellsTheError) {
  for (const char* method : {"gaussian", "sbf", "gem"}) {
    Settings settings = method_settings(method);
    settings.backend = test::backend_under_test();
    settings.threads = 1;
    const SampleBuffer frame = test::defocused_edge({17, 11, 6, 2});
    const Result plain = filter(frame, settings);
    settings.estimate_error = settings.filter_features = true;
    const Result told = filter(frame, settings);
    EXPECT_EQ(plain.image.pixels, told.image.pixels);
    EXPECT_EQ(told.features.channels.back(), "error");
    EXPECT_GT(told.features.channel_count(), 7U);
    double sum = 0;
    for (std::size_t p = 0; p < 17 * 11; ++p) sum += told.features.pixel(p)[told.features.channel_count() - 1];
    EXPECT_GT(sum, 0);
    EXPECT_TRUE(std::isfinite(sum));
  }
}

TEST(Filter, RefusesToTellAnErrorOfTooFewSamples) {
  Settings settings = method_settings("gem");
  settings.backend = test::backend_under_test();
  settings.threads = 1;
  settings.estimate_error = true;
  EXPECT_THROW(filter(test::defocused_edge({9, 7, 3, 2}), settings), Error);
  EXPECT_NO_THROW(filter(test::defocused_edge({9, 7, 4, 2}), settings));
  EXPECT_THROW(filter(test::defocused_edge({9, 7, 1, 2}), gaussian(3)), Error);
}

}  // namespace
}  // namespace rpf
