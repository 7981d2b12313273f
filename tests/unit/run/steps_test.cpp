// The steps beyond the sources in the whole filter: what holds without them holds with them. In the suite Filter, so
// that both backends run it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf {
namespace {

using test::defocused_edge;

struct Step {
  const char* name;
  std::function<void(Settings&)> set;
};

const std::vector<Step> steps = {{"spikes", [](Settings& s) { s.spread_spikes = true; }},
                                 {"polish", [](Settings& s) { s.polish = 0.15F; }},
                                 {"both", [](Settings& s) { s.spread_spikes = true, s.polish = 0.15F; }}};

Settings with(const Step& step) {
  Settings settings = test::small_settings();
  step.set(settings);
  return settings;
}

Image image_of(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  const Result result = filter(samples, settings, control);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result.image;
}

TEST(Filter, StepsChangeTheImageOfTheTestFrame) {  // or else the tests below would prove nothing
  const SampleBuffer samples = defocused_edge({40, 30, 2, 5});
  const Image plain = image_of(samples, test::small_settings());
  for (const Step& step : steps) EXPECT_NE(image_of(samples, with(step)).pixels, plain.pixels) << step.name;
}

TEST(Filter, StepsGiveTheSamePixelsForACrop) {
  const SampleBuffer samples = defocused_edge({50, 40, 2, 5});
  for (const Step& step : steps) {
    Settings crop = with(step);
    const Image whole = image_of(samples, crop);
    crop.crop = Window{22, 17, 6, 5};
    const Image part = image_of(samples, crop);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 6; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(part.pixel(static_cast<std::size_t>(y * 6 + x))[c],
                    whole.pixel(static_cast<std::size_t>((y + 17) * 50 + x + 22))[c])
              << step.name << " " << x << "," << y;
  }
}

TEST(Filter, StepsScaleExactlyWithPowersOfTwo) {
  const SampleBuffer samples = defocused_edge({20, 15, 0, 1});
  for (const Step& step : steps) {
    const std::vector<float> plain = image_of(samples, with(step)).pixels;
    for (const int exponent : {-60, 17}) {
      SampleBuffer scaled = samples;
      test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
      std::vector<float> expected = plain;
      for (float& value : expected) value = std::ldexp(value, exponent);
      EXPECT_EQ(image_of(scaled, with(step)).pixels, expected) << step.name << " 2^" << exponent;
    }
  }
}

TEST(Filter, StepsDoNotDependOnThreadsAndTiles) {
  const SampleBuffer samples = defocused_edge({300, 40, 0, 3});
  for (const Step& step : steps) {
    Settings settings = with(step);
    settings.box_widths = {3};
    const std::vector<float> expected = image_of(samples, settings).pixels;
    settings.threads = 3;
    Control control;
    control.tile_pixels = 77;
    EXPECT_EQ(image_of(samples, settings, control).pixels, expected) << step.name;
  }
}

TEST(Filter, StepsKeepAConstantImageAndEveryShape) {
  for (const Step& step : steps)
    for (const int count : {0, 1, 3})
      for (const auto& [width, height] : {std::pair{1, 1}, {1, 12}, {12, 1}, {9, 8}}) {
        SampleBuffer samples = defocused_edge({width, height, count, 9});
        for (const float value : image_of(samples, with(step)).pixels) EXPECT_TRUE(std::isfinite(value)) << step.name;
        for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.1F);
        const Image flat = image_of(samples, with(step));
        for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
          EXPECT_EQ(flat.pixel(p)[0], samples.first_sample[p] < samples.first_sample[p + 1] ? 0.1F : 0.0F)
              << step.name << " " << p;
      }
}

}  // namespace
}  // namespace rpf
