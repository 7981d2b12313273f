// How wrong a filtered frame says that it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

/// The samples of each pixel dealt out in turn.
std::array<SampleBuffer, 2> halves_of(const SampleBuffer& frame) {
  std::array<SampleBuffer, 2> halves = {frame, frame};
  for (SampleBuffer& half : halves) {
    half.values.clear();
    half.first_sample = {0};
  }
  for (std::size_t p = 0; p + 1 < frame.first_sample.size(); ++p) {
    for (std::uint32_t s = frame.first_sample[p]; s < frame.first_sample[p + 1]; ++s) {
      std::vector<float>& values = halves[(s - frame.first_sample[p]) % 2].values;
      values.insert(values.end(), frame.record(s), frame.record(s) + frame.layout.size());
    }
    for (SampleBuffer& half : halves)
      half.first_sample.push_back(static_cast<std::uint32_t>(half.values.size() / half.layout.size()));
  }
  return halves;
}

std::uint32_t count_of(const SampleBuffer& frame, std::size_t pixel) {
  return frame.first_sample[pixel + 1] - frame.first_sample[pixel];
}

/// Of a pixel's samples, which count as 0 where they are negative.
double mean_of(const SampleBuffer& frame, std::size_t pixel, std::size_t color) {
  double sum = 0;
  for (std::uint32_t s = frame.first_sample[pixel]; s < frame.first_sample[pixel + 1]; ++s)
    sum += std::max(frame.record(s)[color], 0.0F);
  return sum / count_of(frame, pixel);
}

/// (10.1) and (10.2) of the pixels that count, then (10.3), straight from docs/algorithm.md.
class Formula {
 public:
  Formula(const SampleBuffer& frame, const Settings& settings)
      : halves_(halves_of(frame)), whole_(filter(frame, settings).image) {
    for (std::size_t i = 0; i < 2; ++i) filtered_[i] = filter(halves_[i], settings).image;
  }

  double operator()(int x, int y) const {
    const Window& window = whole_.data_window;
    double variance = 0, count = 0;
    std::vector<double> bias;
    for (int to_y = std::max(y - 4, 0); to_y <= std::min(y + 4, window.height - 1); ++to_y)
      for (int to_x = std::max(x - 4, 0); to_x <= std::min(x + 4, window.width - 1); ++to_x) {
        const Window& frame = halves_[0].data_window;
        const int row = window.y + to_y - frame.y, column = window.x + to_x - frame.x;
        const auto of_frame = static_cast<std::size_t>(row * frame.width + column);
        if (count_of(halves_[0], of_frame) == 0 || count_of(halves_[1], of_frame) == 0) continue;
        add(static_cast<std::size_t>(to_y * window.width + to_x), of_frame, variance, bias);
        ++count;
      }
    return count > 0 ? std::sqrt(variance / count + beyond_chance(bias)) : 0;
  }

 private:
  void add(std::size_t pixel, std::size_t of_frame, double& variance, std::vector<double>& bias) const {
    bias.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = filtered_[0].pixel(pixel)[c], b = filtered_[1].pixel(pixel)[c], f = whole_.pixel(pixel)[c];
      const double unit = 3 * (f * f + least_brightness);
      variance += (a - b) * (a - b) / 4 / unit;
      bias.back() += (a - mean_of(halves_[0], of_frame, c)) * (b - mean_of(halves_[1], of_frame, c)) / unit;
    }
  }

  static double beyond_chance(const std::vector<double>& bias) {
    double m = 0, squares = 0;
    for (const double value : bias) m += value / static_cast<double>(bias.size());
    if (m <= 0 || bias.size() < 2) return 0;
    for (const double value : bias) squares += (value - m) * (value - m);
    const double e = std::sqrt(squares / static_cast<double>(bias.size() * (bias.size() - 1)));
    return std::max(0.0, m - e * e / m);
  }

  std::array<SampleBuffer, 2> halves_;
  std::array<Image, 2> filtered_;
  Image whole_;
};

void expect_formula(const SampleBuffer& frame, Settings settings) {
  const Result result = filter(frame, settings);
  settings.estimate_error = false;
  const Formula formula(frame, settings);
  const Window& window = result.features.data_window;
  ASSERT_EQ(result.features.pixels.size(), window.pixel_count());
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      EXPECT_NEAR(*result.features.pixel(static_cast<std::size_t>(y * window.width + x)), formula(x, y),
                  test::tolerance::formula)
          << x << "," << y;
}

/// With all counts of samples, also none, in a window that lies anywhere and of which a part is wanted.
TEST(Filter, TellsTheErrorOfTheFormula) {
  SampleBuffer frame = test::defocused_edge({23, 19, 0, 4});
  for (std::size_t i = 0; i < frame.sample_count(); i += 7) test::value_of(frame, i, "R") = -0.5F;
  frame.data_window.x = frame.display_window.x = -7;
  frame.data_window.y = frame.display_window.y = 30;
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    test::value_of(frame, i, "film.X") -= 7;
    test::value_of(frame, i, "film.Y") += 30;
  }
  Settings settings = gaussian(5);
  settings.clamp_negative = true;
  settings.crop = Window{-4, 32, 16, 13};
  expect_formula(frame, settings);
}

/// Where nothing is wrong but noise, the product that tells the bias is below 0 as often as above.
TEST(Filter, TellsTheErrorOfTheFormulaWithoutBias) {
  test::Dice dice(11);
  expect_formula(picture_of(2, [&](std::size_t) { return 0.5F + dice(); }), gaussian(3));
}

TEST(Filter, TellsHowFarItIsWithTheError) {
  Control control;
  control.tile_pixels = 5;
  double last = 0;
  control.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    last = progress.fraction;
    return true;
  };
  filter(test::defocused_edge({9, 7, 4, 2}), gaussian(3), control);
  EXPECT_GT(last, 0.9);
  EXPECT_LE(last, 1);
}

TEST(Filter, GivesTheSamePictureWhereItTellsTheError) {
  for (const char* method : {"gaussian", "sbf", "gem"}) {
    Settings settings = method_settings(method);
    settings.backend = test::backend_under_test();
    settings.threads = 1;
    const SampleBuffer frame = test::defocused_edge({17, 11, 6, 2});
    settings.filter_features = true;
    const Result plain = filter(frame, settings);
    settings.estimate_error = true;
    const Result told = filter(frame, settings);
    EXPECT_EQ(plain.image.pixels, told.image.pixels);
    EXPECT_EQ(told.features.channels.back(), "error");
    const std::size_t before = plain.features.channel_count();
    ASSERT_EQ(told.features.channel_count(), before + 1);
    EXPECT_GT(before, 6U);
    double sum = 0;
    for (std::size_t p = 0; p < 17 * 11; ++p) {
      const float *of_plain = plain.features.pixel(p), *of_told = told.features.pixel(p);
      EXPECT_TRUE(std::equal(of_plain, of_plain + before, of_told));
      sum += of_told[before];
    }
    EXPECT_GT(sum, 0);
    EXPECT_TRUE(std::isfinite(sum));
  }
}

TEST(Filter, RefusesToTellAnErrorOfTooFewSamples) {
  Settings settings = method_settings("gem");
  settings.backend = test::backend_under_test();
  settings.threads = 1;
  settings.estimate_error = true;
  try {
    filter(test::defocused_edge({9, 7, 3, 2}), settings);
    FAIL() << "one of three samples has no variance";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find("no pixel has 4 samples"), 0U) << e.what();
  }
  EXPECT_NO_THROW(filter(test::defocused_edge({9, 7, 4, 2}), settings));
  EXPECT_THROW(filter(test::defocused_edge({9, 7, 1, 2}), gaussian(3)), Error);
  settings.method = Method::axis_aligned;  // which asks no half for its variance
  SampleBuffer shadows = test::defocused_edge({9, 7, 2, 2});
  test::cast_shadows(shadows);
  EXPECT_NO_THROW(filter(shadows, settings));
}

}  // namespace
}  // namespace rpf
