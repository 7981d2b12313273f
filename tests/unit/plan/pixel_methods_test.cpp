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
};

INSTANTIATE_TEST_SUITE_P(Methods, PixelEveryMethod, testing::Values("nlm", "gem", "sbf"),
                         [](const auto& p) { return p.param; });

TEST_P(PixelEveryMethod, GivesTheSameBitsForThreadsAndRuns) {
  const SampleBuffer samples = defocused_edge({31, 17, 0, 3});
  const std::vector<float> expected = filtered(samples, settings());
  Settings s = settings();
  s.threads = 3;
  EXPECT_EQ(filtered(samples, s), expected);
  s.box_widths.clear();
  s.method = Method::gaussian;
  EXPECT_NE(filtered(samples, s), expected) << "this is the plain mean";
}

TEST_P(PixelEveryMethod, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = defocused_edge({40, 30, 2, 5});
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = filtered_image(samples, settings()), part = filtered_image(samples, crop);
  EXPECT_EQ(part.pixels, test::part_of(whole, *crop.crop));
}

TEST_P(PixelEveryMethod, ScalesWithRadiance) {
  const SampleBuffer samples = defocused_edge();
  for (const int exponent : {-90, -3, 5, 90}) {
    SampleBuffer scaled = samples;
    test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
    std::vector<float> expected = filtered(samples, settings());
    for (float& value : expected) value = std::ldexp(value, exponent);
    EXPECT_EQ(filtered(scaled, settings()), expected) << exponent;
  }
}

TEST_P(PixelEveryMethod, LeavesASingleColorWhatItIs) {
  SampleBuffer samples = defocused_edge({9, 7, 3, 2});
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.3F);
  for (const float value : filtered(samples, settings())) ASSERT_EQ(value, 0.3F);
}

TEST_P(PixelEveryMethod, RemovesNoiseOfAFlatPicture) {
  SampleBuffer samples = defocused_edge({40, 30, 8, 4});
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
  const SampleBuffer samples = defocused_edge({15, 11, 0, 6});
  const Image image = filtered_image(samples, settings());
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    if (samples.first_sample[p] == samples.first_sample[p + 1]) {
      EXPECT_EQ(image.pixel(p)[0], 0) << p;
    }
}

TEST_P(PixelEveryMethod, StaysInsideTheRangeOfItsInputAtAnyRadiance) {
  SampleBuffer samples = defocused_edge({9, 7, 0, 2});
  const float values[] = {0, 1e-42F, 1e-30F, 1, 1e30F, std::numeric_limits<float>::max()};
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = values[i % 6];
  for (const float value : filtered(samples, settings())) {
    ASSERT_GE(value, 0);
    ASSERT_LE(value, std::numeric_limits<float>::max());
  }
}

TEST_P(PixelEveryMethod, RefusesFramesThatDoNotTellTheirNoise) {
  try {
    filter(defocused_edge({9, 7, 1, 2}), settings());
    FAIL() << "one sample a pixel";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    EXPECT_NE(std::string(e.what()).find("two samples"), std::string::npos) << e.what();
  }
}

TEST_P(PixelEveryMethod, AveragesFeaturesAlong) {
  SampleBuffer samples = defocused_edge();
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

}  // namespace
}  // namespace rpf
