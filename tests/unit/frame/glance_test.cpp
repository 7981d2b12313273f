// What is found of samples many at a time, against what is found of each by itself.
#include "frame/glance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "frame/clean.h"
#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t frames = 24;

/// Values at and beyond the limits of everything that is checked.
constexpr float odd_values[] = {nan,   infinity, -infinity, 1e15F, 1.1e15F, -1e15F, 0,     -0.0F,
                                -0.5F, 0.3F,     0.9F,      0.96F, 1,       1.04F,  1.06F, 1.0001F,
                                2,     2.1F,     200,       300,   1e-25F,  1e-42F, 1e30F, -1e-42F};

/// A frame in which one value of 50, or of a few, is odd: of 3 to 150 samples a pixel, and other numbers of samples
/// than fill blocks.
SampleBuffer odd_frame(std::uint32_t seed) {
  constexpr int samples[] = {3, 5, 0, 64, 67, 150};
  SampleBuffer frame = test::every_input({5, 3, samples[seed % 6], seed});
  if (seed % 2 == 0) test::add_channel(frame, "weight", 1);
  if (seed % 3 == 0) frame.data_window.x = -3, frame.data_window.y = 7;
  test::Dice dice(seed);
  const auto one_of = [&](std::size_t n) { return static_cast<std::size_t>(dice() * static_cast<float>(n)); };
  for (std::size_t i = 0; i < frame.sample_count(); i += 2)  // as renderers write what nothing was hit by
    for (std::size_t c = 0; c < frame.layout.size(); ++c) {
      const std::string& slot = frame.layout.slots[c];
      const bool second = is_feature_slot(slot) && (group_of(slot) == "N2" || group_of(slot) == "P2");
      if (second || (i % 6 == 0 && is_feature_slot(slot))) frame.record(i)[c] = nan;
      if (i % 6 == 0 && slot == "feature.hit") frame.record(i)[c] = 0;
    }
  for (float& value : frame.values)
    if (one_of(50) == 0) value = odd_values[one_of(std::size(odd_values))];
  return frame;
}

bool is_missing(float value) { return !(std::fabs(value) <= 1e15F); }

/// The bits that stand for a missing value, so that none has to be put in its place.
bool is_marked(float value) { return std::memcmp(&value, &missing, sizeof value) == 0; }

/// Whether a sample has all of a hit's features, or none of them where that is no fault and marked.
bool is_whole(const float* record, const std::vector<std::size_t>& hit, bool may_lack) {
  const auto lacks = [&](std::size_t c) { return is_missing(record[c]); };
  if (std::none_of(hit.begin(), hit.end(), lacks)) return true;
  return may_lack && std::all_of(hit.begin(), hit.end(), [&](std::size_t c) { return is_marked(record[c]); });
}

bool is_clean(const SampleBuffer& frame, const Columns& columns, std::size_t sample) {
  const float* record = frame.record(sample);
  for (std::size_t c = 0; c < frame.layout.size(); ++c)
    if (!is_feature_slot(frame.layout.slots[c]) && is_missing(record[c])) return false;
  for (const std::size_t c : columns.color)
    if (record[c] < 0) return false;
  if (columns.weight && record[*columns.weight] < 0) return false;
  return is_whole(record, columns.first_hit, record[*columns.hit] == 0) && is_whole(record, columns.second_hit, true);
}

TEST(Glance, FindsTheSamplesThatAreNotClean) {
  for (std::uint32_t seed = 1; seed <= frames; ++seed) {
    const SampleBuffer frame = odd_frame(seed);
    const Columns columns = find_columns(frame, false);
    Glance glance(frame.layout, columns, nullptr);
    Marks marks(frame.sample_count());
    const std::size_t pixels = frame.data_window.pixel_count(), half = pixels / 2;
    glance.look(frame, 0, half, marks.data());
    glance.look(frame, half, pixels, marks.data());
    float brightest = 0;
    std::size_t clean = 0;
    for (std::size_t i = 0; i < frame.sample_count(); ++i) {
      ASSERT_EQ(marks[i] == 0, is_clean(frame, columns, i)) << "frame " << seed << ", sample " << i;
      if (marks[i] != 0) continue;
      ++clean;
      for (const std::size_t c : columns.color) brightest = std::max(brightest, std::fabs(frame.record(i)[c]));
    }
    EXPECT_EQ(glance.brightest(), brightest) << "frame " << seed;
    EXPECT_GT(clean, 0U) << "frame " << seed << " shows nothing";
  }
}

TEST(Glance, MissesNothingThatContradictsAConvention) {
  std::size_t told = 0;
  for (std::uint32_t seed = 1; seed <= frames; ++seed) {
    SampleBuffer frame = odd_frame(seed);
    const std::vector<InputNote> all = check_conventions(frame);  // of every sample by itself
    const Columns columns = find_columns(frame, false);
    const SampleBuffer whole = frame;
    Settings settings = test::small_settings();
    settings.threads = 1 + static_cast<int>(seed % 3);
    Cleaning cleaning(whole, columns, settings);
    cleaning.add(frame);
    const std::vector<InputNote> found = cleaning.report().notes;
    ASSERT_GE(found.size(), all.size()) << "frame " << seed;
    for (std::size_t n = 0; n < all.size(); ++n, ++told) {
      EXPECT_EQ(found[n].what, all[n].what) << "frame " << seed;
      EXPECT_EQ(found[n].count, all[n].count) << all[n].what << " of frame " << seed;
      EXPECT_TRUE(found[n].x == all[n].x && found[n].y == all[n].y) << all[n].what << " of frame " << seed;
    }
  }
  EXPECT_GT(told, 4 * frames) << "film, random numbers, normals and albedo of nearly every frame";
}

/// Of more pixels than a thread looks at, the last three of which hold copies of one sample.
TEST(Glance, TellsTheFirstPixelWhicheverThreadFindsIt) {
  constexpr int width = 64, height = 32, samples = 5;
  SampleBuffer frame = test::every_input({width, height, samples, 3});
  for (std::size_t i = frame.sample_count() - 3 * samples; i < frame.sample_count(); ++i)
    std::copy_n(frame.record(i / samples * samples), frame.layout.size(), frame.record(i));
  const Columns columns = find_columns(frame, false);
  const SampleBuffer whole = frame;
  Settings settings = test::small_settings();
  settings.threads = 3;
  Cleaning cleaning(whole, columns, settings);
  cleaning.add(frame);
  const std::vector<InputNote> notes = cleaning.report().notes;
  const auto copies = std::find_if(notes.begin(), notes.end(), [](const InputNote& note) {
    return note.what.find("whose samples are all the same") != std::string::npos;
  });
  ASSERT_NE(copies, notes.end());
  EXPECT_EQ(copies->count, 3U);
  EXPECT_EQ(copies->x, whole.data_window.x + width - 3);
  EXPECT_EQ(copies->y, whole.data_window.y + height - 1);
}

}  // namespace
}  // namespace rpf
