// Channels that carry no information. In the suite Filter, so that it runs on both backends.
#include <gtest/gtest.h>

#include <limits>

#include "rpf/filter.h"
#include "rpf/scene.h"
#include "test_frames.h"

namespace rpf {
namespace {

using test::small_settings;
using test::value_of;

/// filter(), and the proof that the backend under test ran it.
Result run_filter(const SampleBuffer& samples, const Settings& settings) {
  Result result = filter(samples, settings);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result;
}

/// `two-values`: R depends on the lens only, G on the time only, B on the albedo only. Its other channels, those of
/// bsdf among them, are independent numbers or constant.
SampleBuffer two_values(int samples = 4) {
  SceneOptions options;
  options.width = 96;
  options.height = 54;
  options.samples = samples;
  return render_scene("two-values", options);
}

/// Adds a channel of independent numbers in front of the others, so that a wrong order of what is kept shows.
void add_useless(SampleBuffer& samples, const std::string& slot, std::uint32_t seed) {
  test::Dice dice(seed);
  SampleBuffer more = samples;
  more.layout.slots.insert(more.layout.slots.begin(), slot);
  more.values.clear();
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    more.values.push_back(dice());
    more.values.insert(more.values.end(), samples.record(i), samples.record(i) + samples.layout.size());
  }
  samples = std::move(more);
}

Settings informative_settings() {
  Settings settings = small_settings();
  settings.drop_uninformative = true;
  settings.random = std::vector<std::string>{"all"};
  return settings;
}

TEST(Filter, DropsWhatCarriesNoInformation) {
  for (const int count : {1, 4}) {
    const Result result = run_filter(two_values(count), informative_settings());
    EXPECT_EQ(result.report.random, (std::vector<std::string>{"lens.U", "time"})) << count << " samples a pixel";
    EXPECT_EQ(result.report.features, (std::vector<std::string>{"albedo.R", "albedo.G", "albedo.B"}));
    EXPECT_EQ(result.report.uninformative,
              (std::vector<std::string>{"lens.V", "light.U", "light.V", "bsdf.U", "bsdf.V", "P.X", "P.Y"}));
  }
}

TEST(Filter, WithoutUselessChannelsIsAsIfTheyWereNotThere) {
  SampleBuffer useful = test::defocused_edge({96, 54, 4, 1});
  test::fill(useful, "random.lens.V", 0.5F);  // it moves nothing in this frame
  Settings settings = small_settings();
  settings.random = std::vector<std::string>{"all"};
  const Result expected = run_filter(useful, settings);
  SampleBuffer more = useful;
  add_useless(more, "random.light.U", 11);
  add_useless(more, "feature.noise.X", 12);
  add_useless(more, "feature.noise.Y", 13);
  value_of(more, 5, "feature.noise.X") = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(run_filter(more, settings).image.pixels, expected.image.pixels) << "nothing is dropped unless asked for";
  settings.drop_uninformative = true;
  const Result result = run_filter(more, settings);
  EXPECT_EQ(result.report.uninformative, (std::vector<std::string>{"light.U", "noise.Y", "noise.X"}));
  EXPECT_EQ(result.report.random, expected.report.random);
  EXPECT_EQ(result.report.features, expected.report.features);
  EXPECT_EQ(result.image.pixels, expected.image.pixels);
}

TEST(Filter, LooksForInformationInTheWholeFrameWhateverTheCrop) {
  // Time matters in the left half only, albedo in the right half only: a crop could not know.
  SampleBuffer samples = two_values();
  for (std::size_t p = 0; p < samples.data_window.pixel_count(); ++p)
    for (std::uint32_t i = samples.first_sample[p]; i < samples.first_sample[p + 1]; ++i)
      value_of(samples, i, p % 96 < 48 ? "B" : "G") = value_of(samples, i, "R");
  const Result whole = run_filter(samples, informative_settings());
  EXPECT_EQ(whole.report.random, (std::vector<std::string>{"lens.U", "time"}));
  Settings crop = informative_settings();
  crop.crop = Window{70, 11, 20, 5};
  const Result part = run_filter(samples, crop);
  EXPECT_EQ(part.report.uninformative, whole.report.uninformative);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 20; ++x)
      ASSERT_EQ(part.image.pixel(static_cast<std::size_t>(y * 20 + x))[1],
                whole.image.pixel(static_cast<std::size_t>((y + 11) * 96 + x + 70))[1])
          << x << "," << y;
}

TEST(Filter, KeepsAChannelThatMattersInASmallPartOfTheFrameOnly) {
  SampleBuffer samples = two_values();
  for (std::size_t p = 0; p < samples.data_window.pixel_count(); ++p)
    for (std::uint32_t i = samples.first_sample[p]; i < samples.first_sample[p + 1]; ++i)
      if (p % 96 < 88 || p / 96 > 8) value_of(samples, i, "G") = value_of(samples, i, "R");
  EXPECT_EQ(run_filter(samples, informative_settings()).report.random, (std::vector<std::string>{"lens.U", "time"}));
}

TEST(Filter, KeepsAChannelThatMattersALittleEverywhere) {
  SampleBuffer samples = two_values();
  for (std::size_t i = 0; i < samples.sample_count(); i += 6)
    value_of(samples, i, "R") = value_of(samples, i, "random.lens.V") < 0.5F ? 0.25F : 0.75F;
  EXPECT_EQ(run_filter(samples, informative_settings()).report.random,
            (std::vector<std::string>{"lens.U", "lens.V", "time"}));
}

TEST(Filter, KeepsAllWhereTooLittleCanBeMeasured) {
  Settings settings = informative_settings();
  SampleBuffer samples = test::defocused_edge();
  add_useless(samples, "random.light.U", 11);
  EXPECT_EQ(run_filter(samples, settings).report.uninformative, std::vector<std::string>{});
  settings.box_widths.clear();
  EXPECT_EQ(run_filter(test::defocused_edge({1, 1, 2, 1}), settings).report.uninformative, std::vector<std::string>{});
}

}  // namespace
}  // namespace rpf
