// From a sample buffer to a frame: what is measured over the frame before anything is filtered.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "frame/prepare.h"
#include "test_frames.h"

namespace rpf {
namespace {

using test::value_of;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// A frame whose first hits span a box of 3 x 4 x 0, but for sample 2.
SampleBuffer flat_box() {
  SampleBuffer samples = test::defocused_edge({2, 2, 1, 1});
  for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"}) test::fill(samples, slot, 1);
  test::fill(samples, "feature.N.X", 1);
  value_of(samples, 1, "feature.P.X") = 4;
  value_of(samples, 1, "feature.P.Y") = 5;
  value_of(samples, 2, "feature.P.Z") = 1000;
  return samples;
}

float diagonal(const SampleBuffer& samples) { return prepare(samples, {}).facts.position_diagonal; }

TEST(PositionDiagonal, LeavesOutRaysThatTheHitChannelCallsMissed) {
  SampleBuffer samples = flat_box();
  EXPECT_GT(diagonal(samples), 900.0F);
  test::add_channel(samples, "feature.hit", 1);
  value_of(samples, 2, "feature.hit") = 0;
  EXPECT_EQ(diagonal(samples), 5.0F);
}

TEST(PositionDiagonal, TakesANormalOfZeroForAMissWithoutAHitChannel) {
  SampleBuffer samples = flat_box();
  for (const char* slot : {"feature.N.X", "feature.N.Y", "feature.N.Z"}) value_of(samples, 2, slot) = 0;
  EXPECT_EQ(diagonal(samples), 5.0F);
  test::add_channel(samples, "feature.hit", 1);
  EXPECT_GT(diagonal(samples), 900.0F);  // the hit channel knows better
}

TEST(PositionDiagonal, LeavesOutMissingAndInfinitePositions) {
  SampleBuffer samples = flat_box();
  for (const float bad : {missing, std::numeric_limits<float>::infinity(), 1e30F}) {
    value_of(samples, 2, "feature.P.Z") = bad;
    EXPECT_EQ(diagonal(samples), 5.0F) << bad;
  }
}

TEST(RadianceScale, IsThePowerOfTwoThatBringsTheBrightestTo2To40) {
  for (const float brightest : {1e-45F, 1e-30F, 0.3F, 1.0F, 7.0F, 1e38F}) {
    SampleBuffer samples = test::defocused_edge({2, 2, 1, 1});
    for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0);
    value_of(samples, 3, "G") = -brightest;
    const float scale = prepare(samples, {}).facts.radiance_scale;
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5F) << "not a power of two: " << scale;
    if (brightest > 1e-25F) {
      EXPECT_EQ(std::ilogb(brightest * scale), 40);
    }
  }
}

TEST(Clean, NotesWhatItFoundAndWhereFirst) {
  SampleBuffer samples = test::defocused_edge({4, 3, 1, 1});
  samples.data_window.x = -7;
  value_of(samples, 6, "feature.N.X") = missing;
  value_of(samples, 9, "feature.N.X") = std::numeric_limits<float>::infinity();
  value_of(samples, 5, "random.time") = missing;
  const PreparedFrame prepared = prepare(samples, {});
  ASSERT_FALSE(prepared.notes.empty());
  const InputNote& note = prepared.notes.back();
  EXPECT_EQ(note.what, "samples with missing values of random.time feature.N.X");  // one line, whatever is missing
  EXPECT_EQ(note.count, 3U);
  EXPECT_EQ(note.x, -7 + 1);
  EXPECT_EQ(note.y, 1);
}

/// Takes a sample all features of its first or of its second hit.
void take_hit(SampleBuffer& samples, std::uint32_t sample, bool second, float none = missing) {
  for (const std::string& slot : samples.layout.slots)
    if (is_feature_slot(slot) && (group_of(slot).back() == '2') == second) value_of(samples, sample, slot) = none;
}

TEST(Clean, CountsWhatIsMissingAtHitsAndNotWhereNothingIsHit) {
  SampleBuffer samples = test::every_input({4, 3, 1, 1});
  test::fill(samples, "feature.hit", 1);
  take_hit(samples, 1, true);  // no second hit
  take_hit(samples, 2, false);
  value_of(samples, 2, "feature.hit") = 0;         // no hit
  take_hit(samples, 3, false);                     // a hit without features
  value_of(samples, 4, "feature.N2.X") = missing;  // half a second hit
  take_hit(samples, 6, false, 1e30F);              // no hit, said in another way
  value_of(samples, 6, "feature.hit") = 0;
  const PreparedFrame prepared = prepare(samples, {});
  ASSERT_FALSE(prepared.notes.empty());
  const InputNote& note = prepared.notes.back();
  EXPECT_EQ(note.what.rfind("samples with missing values of", 0), 0U) << note.what;
  EXPECT_EQ(note.count, 2U);
  EXPECT_EQ(note.x, 3);
  for (const float value : prepared.frame.records) ASSERT_FALSE(value > 1e15F);
}

TEST(Records, AreTheSameInPlaceAndElsewhereAlsoWhereTheyGrow) {
  SampleBuffer tight = test::defocused_edge();
  tight.values.shrink_to_fit();
  SampleBuffer roomy = tight;
  roomy.values.reserve(tight.values.size() + 2 * tight.sample_count());
  const float* const place = roomy.values.data();
  const std::size_t columns = tight.layout.size();
  const PreparedFrame elsewhere = prepare(std::move(tight), {}), in_place = prepare(std::move(roomy), {});
  EXPECT_EQ(in_place.frame.variables, columns + 1);  // two of the position inside the pixel; N.Y is constant
  EXPECT_EQ(in_place.frame.records, elsewhere.frame.records);
  EXPECT_EQ(in_place.frame.records.data(), place);
  EXPECT_NE(in_place.frame.records, std::vector<float>(in_place.frame.records.size()));
}

}  // namespace
}  // namespace rpf
