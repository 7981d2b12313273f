// The settings that trade work for error: what stays as it is with them. In the suite Filter, so that both backends run
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf {
namespace {

using test::defocused_edge;

const std::vector<Profile> profiles = {Profile::thesis, Profile::paper};

/// One pass, and one neighborhood of at most 162 samples a pixel in the test frame of 4 samples.
Settings one_pass(Profile profile) {
  Settings settings = test::small_settings();
  settings.profile = profile;
  settings.box_widths = {9};
  return settings;
}

Image image_of(const SampleBuffer& samples, const Settings& settings, const Control& control = {}) {
  const Result result = filter(samples, settings, control);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result.image;
}

bool has_samples(const SampleBuffer& samples, int pixel) {
  return samples.first_sample[static_cast<std::size_t>(pixel)] <
         samples.first_sample[static_cast<std::size_t>(pixel) + 1];
}

/// Whether no pixel before this one, row by row, in its square of `side` x `side` has samples, but this one has.
bool measures(const SampleBuffer& samples, int x, int y, int side) {
  const int width = samples.data_window.width;
  for (int v = y / side * side; v <= y; ++v)
    for (int u = x / side * side; u < x / side * side + side && u < width; ++u)
      if ((v < y || u < x) && has_samples(samples, v * width + u)) return false;
  return has_samples(samples, y * width + x);
}

TEST(Filter, StatisticsBlockLeavesThePixelsThatMeasure) {
  SampleBuffer samples = defocused_edge({25, 19, 0, 3});
  for (const Profile profile : profiles) {
    Settings settings = one_pass(profile);
    const Image alone = image_of(samples, settings);
    settings.statistics_block = 2;
    const Image shared = image_of(samples, settings);
    int measuring = 0, others = 0, changed = 0;
    for (int y = 0; y < 19; ++y)
      for (int x = 0; x < 25; ++x) {
        const auto pixel = static_cast<std::size_t>(y * 25 + x);
        const bool same = std::equal(shared.pixel(pixel), shared.pixel(pixel) + 3, alone.pixel(pixel));
        if (!measures(samples, x, y, 2)) {
          ++others;
          changed += same ? 0 : 1;
          continue;
        }
        ++measuring;
        EXPECT_TRUE(same) << x << "," << y;
      }
    EXPECT_GT(measuring, 100);
    EXPECT_GT(changed, others / 4);  // or else nothing is shared
  }
}

TEST(Filter, StatisticsSamplesBeyondTheNeighborhoodChangeNothing) {
  const SampleBuffer samples = defocused_edge();
  for (const Profile profile : profiles) {
    Settings settings = one_pass(profile);
    const std::vector<float> all = image_of(samples, settings).pixels;
    for (const std::uint32_t most : {162U, 1U << 20, 4294967295U}) {
      settings.statistics_samples = most;
      EXPECT_EQ(image_of(samples, settings).pixels, all) << most;
    }
    settings.statistics_samples = 10;
    EXPECT_NE(image_of(samples, settings).pixels, all);
  }
}

TEST(Filter, NeighborsFactorThatIsNeverReachedChangesNothing) {
  const SampleBuffer samples = defocused_edge();
  for (const Profile profile : profiles) {
    Settings settings = one_pass(profile);
    settings.samples_factor = 8;  // 648 draws and own samples: three portions of draws
    const std::vector<float> all = image_of(samples, settings).pixels;
    for (const double factor : {8.0, 1e6}) {
      settings.neighbors_factor = factor;
      EXPECT_EQ(image_of(samples, settings).pixels, all) << factor;
    }
    settings.neighbors_factor = 0.5;
    EXPECT_NE(image_of(samples, settings).pixels, all);
  }
}

TEST(Filter, NeighborsFactorEndsDrawingAtOnceWhereOwnSamplesAreEnough) {
  const SampleBuffer samples = defocused_edge();
  Settings settings = one_pass(Profile::paper);
  settings.neighbors_factor = 4.5 / 81;  // 4 samples
  const PassReport pass = filter(samples, settings).report.passes.at(0);
  EXPECT_EQ(pass.neighbors, 4);
}

/// Three passes with blocks that the tiles and crops below cut.
Settings shared_settings(Profile profile) {
  Settings settings = test::small_settings();
  settings.profile = profile;
  settings.statistics_block = 3;
  settings.statistics_samples = 30;
  settings.neighbors_factor = 1;
  return settings;
}

TEST(Filter, StatisticsBlockGivesTheSameBitsForThreadsAndTiles) {
  const SampleBuffer samples = defocused_edge({31, 17, 0, 3});
  for (const Profile profile : profiles) {
    Settings settings = shared_settings(profile);
    const std::vector<float> expected = image_of(samples, settings).pixels;
    for (const std::size_t pixels : {1U, 7U, 1000U}) {
      Control control;
      control.tile_pixels = pixels;
      EXPECT_EQ(image_of(samples, settings, control).pixels, expected) << "tiles of " << pixels;
    }
    settings.threads = 3;
    EXPECT_EQ(image_of(samples, settings).pixels, expected) << "3 threads";
  }
}

TEST(Filter, StatisticsBlockGivesTheSamePixelsForACrop) {
  const SampleBuffer samples = defocused_edge({40, 30, 0, 5});
  for (const Profile profile : profiles) {
    Settings settings = shared_settings(profile);
    const Image whole = image_of(samples, settings);
    for (const Window& crop : {Window{17, 11, 6, 5}, Window{20, 14, 1, 1}, Window{38, 0, 2, 30}}) {
      settings.crop = crop;
      const Image part = image_of(samples, settings);
      ASSERT_EQ(part.data_window, crop);
      for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x)
          for (int c = 0; c < 3; ++c)
            ASSERT_EQ(part.pixel(static_cast<std::size_t>(y * crop.width + x))[c],
                      whole.pixel(static_cast<std::size_t>((y + crop.y) * 40 + x + crop.x))[c])
                << crop.x << "," << crop.y << ": " << x << "," << y;
    }
  }
}

TEST(Filter, RefusesEffortThatCannotBeAndNamesIt) {
  const auto refusal = [](const std::function<void(Settings&)>& change) -> std::string {
    Settings settings = test::small_settings();
    change(settings);
    try {
      filter(defocused_edge(), settings);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::usage) << e.what();
      return e.what();
    }
    return "accepted";
  };
  using testing::AllOf, testing::HasSubstr;
  for (const int block : {-1, 0, 17})
    EXPECT_THAT(refusal([block](Settings& s) { s.statistics_block = block; }),
                AllOf(HasSubstr("block"), HasSubstr(std::to_string(block))));
  for (const auto& [factor, text] : {std::pair{0.0, " 0"}, {-2.5, "-2.5"}, {2e6, "2000000"}, {std::nan(""), "nan"}})
    EXPECT_THAT(refusal([f = factor](Settings& s) { s.neighbors_factor = f; }),
                AllOf(HasSubstr("--neighbors-factor"), HasSubstr(text)));
  for (const int block : {1, 16}) EXPECT_EQ(refusal([block](Settings& s) { s.statistics_block = block; }), "accepted");
}

}  // namespace
}  // namespace rpf
