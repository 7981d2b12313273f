// The methods that filter pixels: closed forms, and what must not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::defocused_edge;
using test::value_of;

Image filtered_image(const SampleBuffer& samples, const Settings& settings) {
  Result result = filter(samples, settings);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result.image;
}

std::vector<float> filtered(const SampleBuffer& samples, const Settings& settings) {
  return filtered_image(samples, settings).pixels;
}

double variance_of(const std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float v : values) sum += v;
  for (const float v : values) squares += std::pow(v - sum / static_cast<double>(values.size()), 2);
  return squares / static_cast<double>(values.size());
}

class PixelEveryMethod : public testing::TestWithParam<std::string> {
 protected:
  static Settings settings() {
    Settings s = method_settings(GetParam());
    s.backend = test::backend_under_test();
    s.threads = 1;
    return s;
  }
  static SampleBuffer frame(const test::FrameOptions& options = {}) {
    SampleBuffer samples = defocused_edge(options);
    if (settings().method == Method::axis_aligned) test::cast_shadows(samples);
    return samples;
  }
};

/// Those that tell what is noise.
class PixelNoiseMethod : public PixelEveryMethod {};

INSTANTIATE_TEST_SUITE_P(Methods, PixelEveryMethod, testing::Values("nlm", "gem", "sbf", "axis-aligned"),
                         [](const auto& p) { return p.param == "axis-aligned" ? "shadows" : p.param; });
INSTANTIATE_TEST_SUITE_P(Methods, PixelNoiseMethod, testing::Values("nlm", "gem", "sbf"),
                         [](const auto& p) { return p.param; });

TEST_P(PixelEveryMethod, GivesTheSameBitsForThreadsAndRuns) {
  const SampleBuffer samples = frame({31, 17, 0, 3});
  const std::vector<float> expected = filtered(samples, settings());
  Settings s = settings();
  s.threads = 3;
  EXPECT_EQ(filtered(samples, s), expected);
  s.box_widths.clear();
  s.method = Method::gaussian;
  EXPECT_NE(filtered(samples, s), expected) << "this is the plain mean";
}

TEST_P(PixelEveryMethod, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = frame({40, 30, 2, 5});
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = filtered_image(samples, settings()), part = filtered_image(samples, crop);
  EXPECT_EQ(part.pixels, test::part_of(whole, *crop.crop));
}

TEST_P(PixelEveryMethod, ScalesWithRadiance) {
  const SampleBuffer samples = frame();
  for (const int exponent : {-90, -3, 5, 90}) {
    SampleBuffer scaled = samples;
    test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
    std::vector<float> expected = filtered(samples, settings());
    for (float& value : expected) value = std::ldexp(value, exponent);
    EXPECT_EQ(filtered(scaled, settings()), expected) << exponent;
  }
}

TEST_P(PixelEveryMethod, LeavesASingleColorWhatItIs) {
  SampleBuffer samples = frame({9, 7, 3, 2});
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.3F);
  test::fill(samples, "feature.albedo.R", 0.5F);  // what axis-aligned divides by
  for (const float value : filtered(samples, settings())) ASSERT_EQ(value, 0.3F);
}

TEST_P(PixelEveryMethod, RemovesNoiseOfAFlatPicture) {
  SampleBuffer samples = frame({40, 30, 8, 4});
  for (const char* slot : {"feature.N.X", "feature.P.X", "feature.P.Y", "feature.P.Z", "feature.albedo.R"})
    test::fill(samples, slot, 0);
  test::Dice dice(9);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = dice();
  Settings none = settings();
  none.method = Method::gaussian;
  none.box_widths.clear();
  EXPECT_LT(variance_of(filtered(samples, settings())), 0.2 * variance_of(filtered(samples, none)));
}

TEST_P(PixelEveryMethod, LeavesPixelsWithoutSamplesBlack) {
  const SampleBuffer samples = frame({15, 11, 0, 6});
  const Image image = filtered_image(samples, settings());
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    if (samples.first_sample[p] == samples.first_sample[p + 1]) {
      EXPECT_EQ(image.pixel(p)[0], 0) << p;
    }
}

TEST_P(PixelEveryMethod, StaysInsideTheRangeOfItsInputAtAnyRadiance) {
  SampleBuffer samples = frame({9, 7, 0, 2});
  const float values[] = {0, 1e-42F, 1e-30F, 1, 1e30F, std::numeric_limits<float>::max()};
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = values[i % 6];
  for (const float value : filtered(samples, settings())) {
    ASSERT_GE(value, 0);
    ASSERT_LE(value, std::numeric_limits<float>::max());
  }
}

TEST_P(PixelNoiseMethod, RefusesFramesThatDoNotTellTheirNoise) {
  try {
    filter(frame({9, 7, 1, 2}), settings());
    FAIL() << "one sample a pixel";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    EXPECT_NE(std::string(e.what()).find("two samples"), std::string::npos) << e.what();
  }
}

TEST_P(PixelEveryMethod, AveragesFeaturesAlong) {
  SampleBuffer samples = frame();
  test::fill(samples, "feature.P.X", 7);
  Settings s = settings();
  s.filter_features = true;
  const Image features = filter(samples, s).features;
  for (std::size_t p = 0; p < features.data_window.pixel_count(); ++p)
    for (std::size_t c = 0; c < features.channel_count(); ++c)
      if (features.channels[c] == "P.X") {
        ASSERT_EQ(features.pixel(p)[c], 7) << p;
      }
}

/// A wall at depth 0 that is one unit a pixel, with two samples in a pixel of which each has its own color.
SampleBuffer wall(int width) {
  SampleBuffer samples = defocused_edge({width, 9, 2, 5});
  for (const char* slot : {"feature.N.X", "feature.N.Y", "feature.N.Z", "feature.P.Z"}) test::fill(samples, slot, 0);
  test::fill(samples, "feature.albedo.R", 0.5F);
  for (const char* slot : {"feature.penumbra.slope", "feature.penumbra.width"}) test::add_channel(samples, slot, 0);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    value_of(samples, i, "feature.P.X") = static_cast<float>(i / 2 % static_cast<std::size_t>(width));
    value_of(samples, i, "feature.P.Y") = static_cast<float>(i / 2 / static_cast<std::size_t>(width));
  }
  return samples;
}

Settings settings_of_shadows() {
  Settings s = method_settings("axis-aligned");
  s.backend = test::backend_under_test();
  s.threads = 1;
  return s;
}

void block(SampleBuffer& samples, std::size_t sample, float slope, float width) {
  value_of(samples, sample, "feature.penumbra.slope") = slope;
  value_of(samples, sample, "feature.penumbra.width") = width;
}

TEST(PixelShadows, ReachFivePixelsBeyondWhatIsBlocked) {
  SampleBuffer samples = wall(40);
  block(samples, 2 * (4 * 40 + 20), 0.2F, 9);
  Settings none = settings_of_shadows();
  none.method = Method::gaussian;
  none.box_widths.clear();
  const Image plain = filtered_image(samples, none), image = filtered_image(samples, settings_of_shadows());
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 40; ++x) {
      const auto pixel = static_cast<std::size_t>(y * 40 + x);
      const bool same = plain.pixel(pixel)[0] == image.pixel(pixel)[0];
      EXPECT_EQ(same, std::abs(x - 20) > 5 || std::abs(y - 4) > 5) << x << ',' << y;
    }
}

// (9.22): width / 6, or the pixels' distance times (1 + slope) / 6 where that is larger. One bright pixel in the dark
// shows the weight.
TEST(PixelShadows, AreAsWideAsTheirOccludersSay) {
  for (const auto& [slope, width] : {std::pair{0.5F, 9.0F}, {5.0F, 1e-3F}}) {
    SampleBuffer samples = wall(40);
    for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0);
    for (const std::size_t i : {0, 1}) value_of(samples, 2 * (4 * 40 + 20) + i, "R") = 1;
    block(samples, 2 * (4 * 40 + 20), slope, width);
    const Image image = filtered_image(samples, settings_of_shadows());
    const double beta = std::max<double>(width, 1 + slope) / 6;
    double total = 0;
    for (int i = -15; i <= 15; ++i) total += std::exp(-i * i / (2 * beta * beta));
    double column = 0;
    for (int i = -4; i <= 4; ++i) column += std::exp(-i * i / (2 * beta * beta));
    EXPECT_NEAR(image.pixel(4 * 40 + 20)[0], 1 / (total * column), test::tolerance::picture) << slope;
    EXPECT_NEAR(image.pixel(4 * 40 + 22)[0], std::exp(-2 / (beta * beta)) / (total * column), test::tolerance::picture)
        << slope;
  }
}

TEST(PixelShadows, KeepTheColorOfTheSurface) {
  SampleBuffer samples = wall(20);
  test::Dice dice(3);
  for (const char* slot : {"feature.albedo.G", "feature.albedo.B"}) test::add_channel(samples, slot, 0);
  for (std::size_t i = 0; i < samples.sample_count(); i += 2) {
    block(samples, i, 0.2F, 6 + dice());
    for (const char* c : {"R", "G", "B"}) {
      const float albedo = 0.1F + 0.8F * dice();
      for (const std::size_t k : {i, i + 1}) {
        value_of(samples, k, std::string("feature.albedo.") + c) = albedo;
        value_of(samples, k, c) = 3 * albedo;
      }
    }
  }
  const Image image = filtered_image(samples, settings_of_shadows());
  for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
    EXPECT_NEAR(image.pixel(p)[1], value_of(samples, 2 * p, "G"), test::tolerance::picture) << p;
}

TEST(PixelShadows, NeedToKnowWhatStandsBeforeTheLight) {
  try {
    filter(defocused_edge(), settings_of_shadows());
    FAIL() << "no penumbra";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    EXPECT_NE(std::string(e.what()).find("feature.penumbra.slope"), std::string::npos) << e.what();
  }
  Settings s = settings_of_shadows();
  s.features = std::vector<std::string>{"P", "N"};
  EXPECT_THROW(filter(wall(9), s), Error);
}

}  // namespace
}  // namespace rpf
