// The whole filter on small frames: properties that hold whatever the statistics say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::defocused_edge;
using test::small_settings;
using test::value_of;

Settings paper_settings() {
  Settings settings = small_settings();
  settings.profile = Profile::paper;
  return settings;
}

/// filter(), and the proof that the backend under test ran it.
Result run_filter(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  Result result = filter(samples, settings, control);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result;
}

std::vector<float> filtered(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  return run_filter(samples, settings, control).image.pixels;
}

/// Plain mean of R, G and B of every pixel, in double.
std::vector<double> plain_mean(SampleBuffer& samples) {
  std::vector<double> means;
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    for (const char* slot : {"R", "G", "B"}) {
      double sum = 0;
      for (std::uint32_t i = samples.first_sample[p]; i < samples.first_sample[p + 1]; ++i)
        sum += value_of(samples, i, slot);
      const auto count = samples.first_sample[p + 1] - samples.first_sample[p];
      means.push_back(count > 0 ? sum / count : 0);
    }
  return means;
}

class BothProfiles : public testing::TestWithParam<Profile> {
 protected:
  Settings settings() const { return GetParam() == Profile::paper ? paper_settings() : small_settings(); }
};

INSTANTIATE_TEST_SUITE_P(Profiles, BothProfiles, testing::Values(Profile::thesis, Profile::paper),
                         [](const auto& p) { return p.param == Profile::paper ? "paper" : "thesis"; });

TEST_P(BothProfiles, ChangesTheImageOfTheTestFrame) {  // or else the tests below would prove nothing
  SampleBuffer samples = defocused_edge();
  Settings none = settings();
  none.box_widths.clear();
  EXPECT_NE(filtered(samples, settings()), filtered(samples, none));
}

TEST_P(BothProfiles, KeepsAConstantImageExactly) {
  SampleBuffer samples = defocused_edge();
  test::fill(samples, "R", 0.1F);
  test::fill(samples, "G", 3.0F);
  test::fill(samples, "B", 0.0F);
  const std::vector<float> pixels = filtered(samples, settings());
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    EXPECT_EQ(pixels[i], 0.1F);
    EXPECT_EQ(pixels[i + 1], 3.0F);
    EXPECT_EQ(pixels[i + 2], 0.0F);
  }
}

TEST_P(BothProfiles, ScalesExactlyWithPowersOfTwo) {
  const SampleBuffer samples = defocused_edge();
  const std::vector<float> plain = filtered(samples, settings());
  for (const int exponent : {-60, -1, 17, 60}) {
    SampleBuffer scaled = samples;
    test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
    std::vector<float> expected = plain;
    for (float& value : expected) value = std::ldexp(value, exponent);
    EXPECT_EQ(filtered(scaled, settings()), expected) << "2^" << exponent;
  }
}

TEST_P(BothProfiles, GivesTheSameBitsForThreadsTilesAndRuns) {
  const SampleBuffer samples = defocused_edge({31, 17, 0, 3});
  const std::vector<float> expected = filtered(samples, settings());
  EXPECT_EQ(filtered(samples, settings()), expected) << "second run";
  for (const int threads : {2, 3}) {
    Settings s = settings();
    s.threads = threads;
    EXPECT_EQ(filtered(samples, s), expected) << threads << " threads";
  }
  for (const std::size_t pixels : {1U, 7U, 31U, 64U, 100000U}) {
    Control control;
    control.tile_pixels = pixels;
    EXPECT_EQ(filtered(samples, settings(), control), expected) << "tiles of " << pixels;
  }
}

TEST_P(BothProfiles, DependsOnTheSeed) {
  Settings other = settings();
  other.seed = 2;
  EXPECT_NE(filtered(defocused_edge(), other), filtered(defocused_edge(), settings()));
}

TEST_P(BothProfiles, DropsAConstantChannelWithoutATrace) {
  const SampleBuffer samples = defocused_edge();
  SampleBuffer more = samples;
  test::add_channel(more, "feature.flat", 4.5F);
  test::add_channel(more, "random.light.U", 0.5F);
  const Result result = run_filter(more, settings());
  EXPECT_EQ(result.image.pixels, filtered(samples, settings()));
  EXPECT_EQ(result.report.dropped, (std::vector<std::string>{"light.U", "N.Y", "flat"}));
}

TEST_P(BothProfiles, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = defocused_edge({40, 30, 2, 5});
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = run_filter(samples, settings()).image, part = run_filter(samples, crop).image;
  EXPECT_EQ(part.data_window, *crop.crop);
  EXPECT_EQ(part.pixels, test::part_of(whole, *crop.crop));
}

TEST_P(BothProfiles, DoesNotDependOnThePlaceOfTheDataWindow) {
  SampleBuffer samples = defocused_edge();
  const std::vector<float> expected = filtered(samples, settings());
  samples.data_window.x = -8;
  samples.data_window.y = 1024;
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {  // shifts that 16-bit film positions survive exactly
    value_of(samples, i, "film.X") -= 8;
    value_of(samples, i, "film.Y") += 16;
  }
  EXPECT_EQ(filtered(samples, settings()), expected);
}

TEST_P(BothProfiles, SurvivesAWorldOffsetThatTheInputSurvives) {
  SampleBuffer samples = defocused_edge();
  const auto snap = [](float v) { return std::round(v * 64) / 64; };
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"})
      value_of(samples, i, slot) = snap(value_of(samples, i, slot));
  const std::vector<float> expected = filtered(samples, settings());
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"})
      value_of(samples, i, slot) += 512;  // far larger, and section 4 counts small spreads as none
  EXPECT_EQ(filtered(samples, settings()), expected);
}

TEST_P(BothProfiles, LeavesOutSamplesThatAreNotFinite) {
  SampleBuffer samples = defocused_edge({60, 9, 3, 1});
  Settings one_pass = settings();
  one_pass.box_widths = {9};
  const std::vector<float> expected = filtered(samples, one_pass);
  value_of(samples, 3, "G") = std::numeric_limits<float>::quiet_NaN();
  value_of(samples, 4, "R") = std::numeric_limits<float>::infinity();
  const Result result = run_filter(samples, one_pass);
  ASSERT_EQ(result.report.notes.size(), 1U);
  EXPECT_EQ(result.report.notes[0].count, 2U);
  EXPECT_EQ(result.report.notes[0].x, 1);
  for (const float value : result.image.pixels) EXPECT_TRUE(std::isfinite(value));
  for (std::size_t p = 0; p < 60 * 9; ++p)  // pixel 1 is bad; the box reaches four pixels
    if (p % 60 > 5 || p / 60 > 4) {
      EXPECT_EQ(result.image.pixel(p)[0], expected[3 * p]) << p;
    }
}

TEST_P(BothProfiles, HandlesEveryShapeAndCount) {
  for (const int samples : {0, 1, 2, 3, 16})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 12}, {12, 1}, {3, 2}}) {
      const auto pixels = filtered(defocused_edge({width, height, samples, 9}), settings());
      EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](float v) { return std::isfinite(v); }));
    }
}

TEST(Filter, WithoutSamplesIsBlack) {
  SampleBuffer samples = defocused_edge();
  std::fill(samples.first_sample.begin(), samples.first_sample.end(), 0U);
  samples.values.clear();
  for (const float value : filtered(samples, small_settings())) EXPECT_EQ(value, 0.0F);
}

TEST(Filter, StaysInsideTheConvexHullOfTheSamples) {
  SampleBuffer samples = defocused_edge({21, 15, 4, 8});
  value_of(samples, 100, "R") = 1e4F;
  Settings settings = small_settings();
  settings.noise = 0.5F;
  const Image image = run_filter(samples, settings).image;
  const char* slots[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    float least = value_of(samples, 0, slots[c]), largest = least;
    for (std::size_t i = 0; i < samples.sample_count(); ++i) {
      least = std::min(least, value_of(samples, i, slots[c]));
      largest = std::max(largest, value_of(samples, i, slots[c]));
    }
    for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p) {
      EXPECT_GE(image.pixel(p)[c], least);
      EXPECT_LE(image.pixel(p)[c], largest);
    }
  }
}

TEST(Filter, WithOneSampleAndBoxWidthOneChangesNothing) {
  SampleBuffer samples = defocused_edge({13, 9, 1, 1});
  Settings settings = small_settings();
  settings.box_widths = {1, 1};
  const std::vector<float> pixels = filtered(samples, settings);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) EXPECT_EQ(pixels[3 * i], value_of(samples, i, "R"));
}

TEST(Filter, WithoutPassesIsThePlainMean) {
  SampleBuffer samples = defocused_edge({13, 9, 0, 1});
  Settings settings = small_settings();
  settings.box_widths.clear();
  const std::vector<float> pixels = filtered(samples, settings);
  const std::vector<double> means = plain_mean(samples);
  for (std::size_t i = 0; i < means.size(); ++i)
    EXPECT_NEAR(pixels[i], means[i], test::tolerance::pixel_mean * means[i]);
}

TEST(Filter, WeightsSamplesInThePixelMean) {
  SampleBuffer samples = defocused_edge({5, 4, 3, 1});
  test::add_channel(samples, "weight", 0.0F);
  for (std::size_t i = 0; i < samples.sample_count(); i += 3)
    value_of(samples, i, "weight") = 0.25F;  // only the first of each pixel counts
  Settings settings = small_settings();
  settings.box_widths.clear();
  const std::vector<float> pixels = filtered(samples, settings);
  for (std::size_t p = 0; p < 20; ++p) EXPECT_EQ(pixels[3 * p], value_of(samples, 3 * p, "R"));
}

// Found by fuzz_filter: sums of such weights and alphas were infinite, and a pixel NaN.
TEST(Filter, StaysFiniteWithHugeWeightsAndAlphas) {
  constexpr float huge = std::numeric_limits<float>::max();
  SampleBuffer samples = defocused_edge({5, 4, 4, 1});
  test::add_channel(samples, "weight", 1.0F);
  test::add_channel(samples, "A", 1.0F);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    value_of(samples, i, "weight") = i % 4 < 2 ? huge : 1e15F;
    value_of(samples, i, "A") = i % 8 < 4 ? huge : -huge;
  }
  const Result result = run_filter(samples, small_settings());
  for (const float value : result.image.pixels) EXPECT_TRUE(std::isfinite(value));
  ASSERT_EQ(result.report.notes.size(), 2U);
  EXPECT_EQ(result.report.notes[0].count, 40U);  // samples left out
  EXPECT_EQ(result.report.notes[1].count, 40U);  // alphas of the others
}

TEST(Filter, FiltersAlphaAndFeaturesWithTheSameWeights) {
  SampleBuffer samples = defocused_edge();
  test::add_channel(samples, "A", 0.0F);
  test::add_channel(samples, "feature.copy", 0.0F);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    value_of(samples, i, "A") = value_of(samples, i, "feature.copy") = value_of(samples, i, "R");
  Settings settings = small_settings();
  settings.filter_features = true;
  const Result result = run_filter(samples, settings);
  EXPECT_EQ(result.image.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(result.features.channels.back(), "copy");
  const std::size_t last = result.features.channel_count() - 1;
  for (std::size_t p = 0; p < result.image.data_window.pixel_count(); ++p) {
    EXPECT_EQ(result.image.pixel(p)[3], result.image.pixel(p)[0]);
    EXPECT_EQ(result.features.pixel(p)[last], result.image.pixel(p)[0]);
  }
}

TEST(Filter, ClampsNegativeRadianceOnRequest) {
  SampleBuffer samples = defocused_edge();
  for (std::size_t i = 0; i < samples.sample_count(); ++i) value_of(samples, i, "R") = -1.0F;
  Settings settings = small_settings();
  const Result kept = run_filter(samples, settings);
  EXPECT_EQ(kept.image.pixels[0], -1.0F);
  EXPECT_EQ(kept.report.notes.at(0).count, samples.sample_count());
  settings.clamp_negative = true;
  EXPECT_EQ(filtered(samples, settings)[0], 0.0F);
}

TEST(Filter, StopsWhenTheCallerSaysSo) {
  Control control;
  control.tile_pixels = 5;
  int calls = 0;
  control.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, 0.0);
    EXPECT_LE(progress.fraction, 1.0);
    return ++calls < 10;
  };
  try {
    run_filter(defocused_edge(), small_settings(), control);
    FAIL() << "not cancelled";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::cancelled);
  }
  EXPECT_EQ(calls, 10);
}

TEST(Filter, ReportsWhatThePassesDid) {
  const Result result = run_filter(defocused_edge({31, 17, 4, 2}), small_settings());
  ASSERT_EQ(result.report.passes.size(), 3U);
  const PassReport& first = result.report.passes[0];
  EXPECT_EQ(first.box_width, 9);
  EXPECT_GT(first.neighbors, 4);
  EXPECT_LE(first.neighbors, 40);
  for (const double share : {first.acceptance, first.fraction_random}) {
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 1);
  }
  EXPECT_NEAR(first.energy, 1, 0.2);
  EXPECT_EQ(result.report.random, (std::vector<std::string>{"lens.U", "lens.V", "time", "pixel.X", "pixel.Y"}));
}

TEST(Filter, SlotsThatAreNotNeededChangeNoBit) {
  SampleBuffer samples = defocused_edge();
  for (const char* slot : {"random.bsdf.U", "feature.P2.X", "feature.uv.U"}) {
    test::add_channel(samples, slot, 0);
    test::Dice dice(7);
    for (std::size_t i = 0; i < samples.sample_count(); ++i) value_of(samples, i, slot) = 30 * dice();
  }
  using Groups = std::vector<std::string>;
  for (const Groups& features : {Groups{"N", "P"}, Groups{"albedo"}, Groups{"P2"}, Groups{"uv"}, Groups{}})
    for (const bool second_hits_reject : {false, true}) {
      Settings settings = small_settings();
      settings.features = features;
      settings.reject_second_hit = second_hits_reject;
      const std::vector<std::string> needed = needed_slots(samples.layout, settings);
      ASSERT_LT(needed.size(), samples.layout.size());
      EXPECT_EQ(filtered(test::with_slots(samples, needed), settings), filtered(samples, settings));
    }
}

TEST(Filter, RefusesMoreMemoryThanAllowed) {
  Settings settings = small_settings();
  settings.max_memory = 1000;
  try {
    run_filter(defocused_edge(), settings);
    FAIL() << "not refused";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::memory);
  }
}

TEST(Filter, RefusesInvalidBuffers) {
  const auto kind_of = [](const SampleBuffer& samples) {
    try {
      run_filter(samples, small_settings());
    } catch (const Error& e) {
      return e.kind();
    }
    return ErrorKind::internal;
  };
  SampleBuffer no_green = defocused_edge();
  no_green.layout.slots[1] = "feature.other";
  EXPECT_EQ(kind_of(no_green), ErrorKind::input);
  SampleBuffer twice = defocused_edge();
  twice.layout.slots.back() = "R";
  EXPECT_EQ(kind_of(twice), ErrorKind::input);
  SampleBuffer short_values = defocused_edge();
  short_values.values.pop_back();
  EXPECT_EQ(kind_of(short_values), ErrorKind::input);
  SampleBuffer unsorted = defocused_edge();
  unsorted.first_sample[3] = 9999;
  EXPECT_EQ(kind_of(unsorted), ErrorKind::input);
}

}  // namespace
}  // namespace rpf
