// The methods with fixed weights: closed forms, and what must not matter.
#include "rpf/methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::defocused_edge;
using test::value_of;

Settings settings_for(const std::string& method) {
  Settings settings = method_settings(method);
  settings.backend = test::backend_under_test();
  settings.threads = 1;
  settings.box_widths = {7, 3};
  settings.sigma_color = 0.3F;
  return settings;
}

Image filtered_image(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  Result result = filter(samples, settings, control);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result.image;
}

std::vector<float> filtered(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  return filtered_image(samples, settings, control).pixels;
}

/// An image of width x height with the color value(x, y) in all channels.
template <typename Value>
SampleBuffer image_of(int width, int height, Value value) {
  Image image;
  image.data_window = image.display_window = {0, 0, width, height};
  image.channels = {"R", "G", "B"};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.insert(image.pixels.end(), 3, value(x, y));
  return samples_of_image(image);
}

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  static Settings settings() { return settings_for(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::Values("gaussian", "bilateral", "cross-bilateral"),
                         [](const auto& p) { return p.param == "cross-bilateral" ? "cross" : p.param; });

TEST(Methods, HaveNames) {
  for (const std::string& name : method_names()) EXPECT_EQ(name_of(method_settings(name).method), name);
  EXPECT_THROW(method_settings("median"), Error);
}

TEST_P(EveryMethod, GivesTheSameBitsForThreadsTilesAndRuns) {
  const SampleBuffer samples = defocused_edge({31, 17, 0, 3});
  const std::vector<float> expected = filtered(samples, settings());
  EXPECT_NE(expected, filtered(samples, [] {
              Settings none = settings();
              none.box_widths.clear();
              return none;
            }()));
  Settings s = settings();
  s.threads = 3;
  EXPECT_EQ(filtered(samples, s), expected);
  for (const std::size_t pixels : {1U, 7U, 64U}) {
    Control control;
    control.tile_pixels = pixels;
    EXPECT_EQ(filtered(samples, settings(), control), expected) << "tiles of " << pixels;
  }
}

TEST_P(EveryMethod, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = defocused_edge({40, 30, 2, 5});
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = filtered_image(samples, settings()), part = filtered_image(samples, crop);
  EXPECT_EQ(part.pixels, test::part_of(whole, *crop.crop));
}

TEST_P(EveryMethod, KnowsNothingOfRandomParametersAndProfiles) {
  const SampleBuffer samples = defocused_edge();
  Settings other = settings();
  other.profile = Profile::paper;
  other.seed = 9;
  other.noise = 1;
  other.drop_uninformative = true;
  other.random = std::vector<std::string>{"lens"};
  EXPECT_EQ(filtered(samples, other), filtered(samples, settings()));
}

TEST_P(EveryMethod, ScalesWithRadianceAndItsSigma) {
  const SampleBuffer samples = defocused_edge();
  for (const int exponent : {-90, -3, 5, 90}) {
    SampleBuffer scaled = samples;
    test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
    Settings s = settings();
    s.sigma_color = std::ldexp(s.sigma_color, exponent);
    std::vector<float> expected = filtered(samples, settings());
    for (float& value : expected) value = std::ldexp(value, exponent);
    EXPECT_EQ(filtered(scaled, s), expected) << exponent;
  }
}

TEST_P(EveryMethod, StaysInsideTheRangeOfItsInputAtAnyRadianceAndSigma) {
  SampleBuffer samples = defocused_edge({9, 7, 0, 2});
  const float values[] = {0, 1e-42F, 1e-30F, 1, 1e30F, std::numeric_limits<float>::max()};
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = values[i % 6];
  for (const float sigma : {1e-30F, 1.0F, 1e30F}) {
    Settings s = settings();
    s.sigma_color = sigma;
    s.sigma_feature = 1e-6F;
    for (const float value : filtered(samples, s)) {
      ASSERT_GE(value, 0);
      ASSERT_LE(value, std::numeric_limits<float>::max());
    }
  }
}

TEST_P(EveryMethod, TakesTheMiddleOfThePixelForAMissingPosition) {
  SampleBuffer missing = defocused_edge(), middle = missing;
  for (std::size_t pixel = 0; pixel + 1 < missing.first_sample.size(); ++pixel)
    for (std::uint32_t i = missing.first_sample[pixel]; i < missing.first_sample[pixel + 1]; i += 2) {
      value_of(missing, i, "film.X") = value_of(missing, i, "film.Y") = NAN;
      value_of(middle, i, "film.X") = static_cast<float>(pixel % 13) + 0.5F;
      value_of(middle, i, "film.Y") = static_cast<float>(pixel / 13) + 0.5F;
    }
  EXPECT_EQ(filtered(missing, settings()), filtered(middle, settings()));
}

TEST_P(EveryMethod, AveragesAlphaWithTheWeightsOfTheColor) {
  SampleBuffer samples = defocused_edge();
  test::add_channel(samples, "A", 0);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    value_of(samples, i, "A") = 0.25F * value_of(samples, i, "G");
  const Image image = filtered_image(samples, settings());
  ASSERT_EQ(image.channels.back(), "A");
  for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
    ASSERT_NEAR(image.pixel(p)[3], 0.25F * image.pixel(p)[1], test::tolerance::pixel_mean);
}

// One pixel of light: what every pixel gets of it is its weight, less at the border, where the box is cut.
TEST(Methods, GaussianSpreadsAPixelLikeAGaussian) {
  Settings s = settings_for("gaussian");
  s.box_widths = {5};
  const std::vector<float> pixels =
      filtered(image_of(9, 9, [](int x, int y) { return x == 4 && y == 4 ? 1.0F : 0.0F; }), s);
  double sum = 0;
  const auto weight = [](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2 * 1.25 * 1.25)); };
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) sum += weight(dx, dy);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x)
      EXPECT_NEAR(pixels[static_cast<std::size_t>(3 * (9 * y + x))], weight(x - 4, y - 4) / sum,
                  test::tolerance::formula)
          << x << "," << y;
  EXPECT_EQ(pixels[3 * (9 * 4 + 1)], 0) << "outside the box";
}

TEST(Methods, BilateralKeepsAnEdgeThatIsAboveItsSigmaAndIsAGaussianWithoutOne) {
  const SampleBuffer edge = image_of(12, 7, [](int x, int) { return x < 6 ? 0.25F : 0.75F; });
  Settings s = settings_for("bilateral");
  s.sigma_color = 0.01F;
  const std::vector<float> kept = filtered(edge, s);
  for (std::size_t p = 0; p < 84; ++p) ASSERT_NEAR(kept[3 * p], p % 12 < 6 ? 0.25F : 0.75F, test::tolerance::formula);
  s.sigma_color = 1e30F;
  EXPECT_EQ(filtered(edge, s), filtered(edge, settings_for("gaussian")));
}

TEST(Methods, CrossBilateralIsBilateralWithoutFeatures) {
  const SampleBuffer samples = defocused_edge();
  Settings s = settings_for("cross-bilateral");
  EXPECT_NE(filtered(samples, s), filtered(samples, settings_for("bilateral")));
  s.features = std::vector<std::string>{};
  EXPECT_EQ(filtered(samples, s), filtered(samples, settings_for("bilateral")));
}

TEST(Methods, CrossBilateralDoesNotDependOnTheUnitOfLength) {
  const SampleBuffer meters = defocused_edge();
  SampleBuffer other = meters;
  for (std::size_t i = 0; i < other.sample_count(); ++i)
    for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"}) value_of(other, i, slot) *= 1024;
  EXPECT_EQ(filtered(other, settings_for("cross-bilateral")), filtered(meters, settings_for("cross-bilateral")));
}

TEST(Methods, RefuseSigmasThatCannotBe) {
  for (const float wrong : {0.0F, -1.0F, NAN, std::numeric_limits<float>::infinity()}) {
    Settings color = settings_for("bilateral"), feature = color;
    color.sigma_color = feature.sigma_feature = wrong;
    EXPECT_THROW(filter(defocused_edge(), color), Error) << wrong;
    EXPECT_THROW(filter(defocused_edge(), feature), Error) << wrong;
  }
}

TEST(SamplesOfImage, AreOneAPixelInItsCenter) {
  Image image;
  image.data_window = {-3, 7, 2, 1};
  image.channels = {"A", "B", "G", "R", "depth"};
  image.pixels = {0.5F, 3, 2, 1, 9, 1, 6, 5, 4, 9};
  SampleBuffer samples = samples_of_image(image);
  samples.validate();
  EXPECT_EQ(samples.first_sample, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(samples.layout.slots, (std::vector<std::string>{"R", "G", "B", "film.X", "film.Y", "A"}));
  EXPECT_EQ(samples.values, (std::vector<float>{1, 2, 3, -2.5F, 7.5F, 0.5F, 4, 5, 6, -1.5F, 7.5F, 1}));
  image.channels = {"Y"};
  image.pixels = {0.25F, 0.5F};
  samples = samples_of_image(image);
  EXPECT_EQ(samples.values, (std::vector<float>{0.25F, 0.25F, 0.25F, -2.5F, 7.5F, 0.5F, 0.5F, 0.5F, -1.5F, 7.5F}));
  image.channels = {"R", "G"};
  EXPECT_THROW(samples_of_image(image), Error);
}

}  // namespace
}  // namespace rpf
