// Pixels that lose all their samples, and light that overflowed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "frame/prepare.h"
#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

/// A frame of one sample a pixel, gray as its column says, NaN in a square hole.
SampleBuffer ramp_with_hole(int side, int begin, int end) {
  SampleBuffer samples = test::defocused_edge({side, side, 1, 1});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const bool lost = x >= begin && x < end && y >= begin && y < end;
      for (const char* slot : {"R", "G", "B"})
        test::value_of(samples, static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + x, slot) =
            lost ? nan : 1 + static_cast<float>(x);
    }
  return samples;
}

Settings plain() {
  Settings settings = test::small_settings();
  settings.box_widths = {};
  return settings;
}

const InputNote* note_of(const Report& report, const std::string& part) {
  for (const InputNote& note : report.notes)
    if (note.what.find(part) != std::string::npos) return &note;
  return nullptr;
}

TEST(LostPixels, GetTheMeanOfTheirNeighborsRingByRing) {
  const Result result = filter(ramp_with_hole(9, 3, 6), plain());
  const auto red = [&](int x, int y) { return result.image.pixel(static_cast<std::size_t>(y) * 9 + x)[0]; };
  // By hand: the corner's five neighbors outside lie in the columns 2, 2, 2, 3, 4; the edge's three in 3, 4, 5.
  EXPECT_FLOAT_EQ(red(3, 3), 1 + (2 + 2 + 2 + 3 + 4) / 5.0F);
  EXPECT_FLOAT_EQ(red(4, 3), 1 + 4.0F);
  EXPECT_FLOAT_EQ(red(4, 4), 1 + 4.0F);  // the middle: the mean of the ring, which is even
  const InputNote* note = note_of(result.report, "filled from their neighbors");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->count, 9U);
  EXPECT_EQ(note->x, 3);
  EXPECT_EQ(note->y, 3);
}

TEST(LostPixels, OfAWholeFrameAreBlack) {
  const Result result = filter(ramp_with_hole(4, 0, 4), plain());
  for (const float value : result.image.pixels) EXPECT_EQ(value, 0.0F);
  EXPECT_EQ(note_of(result.report, "filled"), nullptr);
  ASSERT_NE(note_of(result.report, "black"), nullptr);
  EXPECT_EQ(note_of(result.report, "black")->count, 16U);
}

TEST(LostPixels, AreTheSameInACrop) {
  Settings settings = test::small_settings();
  const Result whole = filter(ramp_with_hole(12, 4, 7), settings);
  settings.crop = Window{3, 3, 5, 5};
  const Result part = filter(ramp_with_hole(12, 4, 7), settings);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(part.image.pixel(static_cast<std::size_t>(y) * 5 + x)[1],
                whole.image.pixel(static_cast<std::size_t>(y + 3) * 12 + x + 3)[1]);
}

TEST(InfiniteRadiance, OfHalfIsTheLargestHalfAndOfFloatWhatTheSettingSays) {
  const auto brightest = [](bool half, bool clamp) {
    SampleBuffer samples = ramp_with_hole(3, 0, 0);
    for (const char* slot : {"R", "G", "B"}) test::value_of(samples, 4, slot) = infinity;
    if (half) samples.half_slots = {"R", "G", "B"};
    Settings settings = plain();
    settings.clamp_infinite = clamp;
    return filter(std::move(samples), settings).image.pixel(4)[0];
  };
  EXPECT_EQ(brightest(true, false), 65504.0F);
  EXPECT_EQ(brightest(true, true), 65504.0F);
  EXPECT_EQ(brightest(false, true), std::numeric_limits<float>::max());
  EXPECT_FLOAT_EQ(brightest(false, false), 2.0F);  // the mean of the columns around it
}

TEST(InfiniteRadiance, BelowZeroIsNoLight) {
  SampleBuffer samples = ramp_with_hole(3, 0, 0);
  test::value_of(samples, 4, "G") = -infinity;
  samples.half_slots = {"R", "G", "B"};
  EXPECT_NE(note_of(filter(std::move(samples), plain()).report, "left out"), nullptr);
}

}  // namespace
}  // namespace rpf
