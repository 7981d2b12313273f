// Values that are none (docs/stability.md, "Values that are none"): they cost themselves and nothing else.
#include <algorithm>
#include <cmath>
#include <limits>

#include "arbitrary.h"
#include "rpf/io.h"
#include "temporary_folder.h"

namespace rpf {
namespace {

using namespace test;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Any sample whose world position is not at the border of the scene's box: the box, and with it the tolerance of
/// positions in the whole frame, stays as it is without the sample.
std::uint32_t any_inner_sample(SampleBuffer& samples) {
  const std::uint32_t chosen = any_sample(samples);
  for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"}) {
    bool above = false, below = false;
    for (std::uint32_t i = 0; i < samples.sample_count(); ++i) {
      above = above || (i != chosen && value_of(samples, i, slot) >= value_of(samples, chosen, slot));
      below = below || (i != chosen && value_of(samples, i, slot) <= value_of(samples, chosen, slot));
    }
    RC_PRE(above && below);
  }
  return chosen;
}

InputNote note_of(const Result& result, const std::string& what) {
  for (const InputNote& note : result.report.notes)
    if (note.what == what) return note;
  return {"", 0, -1, -1};
}

RC_GTEST_PROP(BadColor, CostsItsSampleAndNothingElse, ()) {
  SampleBuffer good = any_frame(), bad = good;
  const Settings settings = any_settings();
  const std::uint32_t sample = any_inner_sample(good);
  const int pixel = pixel_of(good, sample);
  const std::string slot = *rc::gen::elementOf(std::vector<std::string>{"R", "G", "B"});
  value_of(bad, sample, slot) = *rc::gen::element(missing, infinity, -infinity);
  const Result result = run(bad, settings);
  const InputNote note = note_of(result, "samples left out: R, G or B not finite");
  RC_ASSERT(note.count == 1U);
  RC_ASSERT(note.y * 24 + note.x == pixel);
  const bool is_filled = good.first_sample[pixel + 1] - good.first_sample[pixel] == 1;  // from its neighbors
  RC_ASSERT(is_filled || difference(result.image.pixels, filtered(without(good, sample), settings), 24) == "");
  RC_ASSERT(difference_beyond_reach(result.image.pixels, filtered(good, settings), 24, pixel) == "");
}

RC_GTEST_PROP(BadValue, OfAFeatureOrRandomParameterIsMissing, ()) {
  SampleBuffer good = any_frame(), bad = good;
  const Settings settings = any_settings();
  const std::uint32_t sample = any_inner_sample(good);
  const int pixel = pixel_of(good, sample);
  const std::string slot = *rc::gen::elementOf(std::vector<std::string>{"random.lens.U", "random.time", "feature.N.X",
                                                                        "feature.P.Y", "feature.albedo.R", "film.X"});
  value_of(bad, sample, slot) = missing;
  const Result result = run(bad, settings);
  const InputNote note = note_of(result, "samples with missing values of " + slot);
  RC_ASSERT(note.count == 1U);
  RC_ASSERT(note.y * 24 + note.x == pixel);
  RC_ASSERT(not_finite(result.image.pixels) == "");
  RC_ASSERT(difference_beyond_reach(result.image.pixels, filtered(good, settings), 24, pixel) == "");
  value_of(bad, sample, slot) = *rc::gen::element(infinity, -infinity, 1e38F, -2e15F);
  RC_ASSERT(difference(filtered(bad, settings), result.image.pixels, 24) == "");
}

RC_GTEST_PROP(BadValue, InAllSamplesIsAChannelThatIsNotThere, ()) {
  SampleBuffer good = any_frame(), bad = good, absent = good;
  const Settings settings = any_settings();
  fill(bad, "feature.albedo.R", *rc::gen::element(missing, infinity, 1e38F));
  fill(absent, "feature.albedo.R", 0.5F);
  const Result result = run(bad, settings);
  RC_ASSERT(note_of(result, "samples with missing values of feature.albedo.R").count == good.sample_count());
  RC_ASSERT(difference(result.image.pixels, filtered(absent, settings), 24) == "");
}

RC_GTEST_PROP(BadWeight, CostsItsSampleAndNothingElse, ()) {
  SampleBuffer good = any_uniform_frame();
  const Settings settings = any_settings();
  add_channel(good, "weight", 1);
  SampleBuffer bad = good;
  const std::uint32_t sample = any_inner_sample(good);
  value_of(bad, sample, "weight") = *rc::gen::element(missing, infinity, -1.0F, 1e38F);
  const Result result = run(bad, settings);
  RC_ASSERT(note_of(result, "samples left out: weight not a number from 0 to 1e15").count == 1U);
  RC_ASSERT(difference(result.image.pixels, filtered(without(good, sample), settings), 24) == "");
}

TEST(BadAlpha, IsZeroAndCounted) {
  SampleBuffer samples = defocused_edge({24, 16, 4, 1});
  add_channel(samples, "A", 1);
  SampleBuffer zero = samples;
  value_of(samples, 100, "A") = missing;
  value_of(samples, 900, "A") = -infinity;
  value_of(zero, 100, "A") = value_of(zero, 900, "A") = 0;
  Settings settings = small_settings();
  settings.box_widths = {7, 3};
  const Result result = run(samples, settings);
  EXPECT_EQ(result.image.pixels, filtered(zero, settings));
  const InputNote note = note_of(result, "values of alpha not finite or beyond 1e15, set to 0");
  EXPECT_EQ(note.count, 2U);
  EXPECT_EQ(note.y * 24 + note.x, 25);
}

// What happened to the data is told: in the report, and in the attributes of the file.
TEST(Notes, AreInTheImagesAttributesWithCountAndFirstPlace) {
  SampleBuffer samples = defocused_edge({24, 16, 4, 1});
  samples.data_window.x = -7;
  for (std::uint32_t i = 0; i < samples.sample_count(); ++i) value_of(samples, i, "film.X") -= 7;
  value_of(samples, 41, "R") = missing;
  value_of(samples, 44, "G") = infinity;
  value_of(samples, 97, "B") = -1;
  value_of(samples, 100, "feature.N.X") = missing;
  value_of(samples, 104, "random.time") = infinity;
  for (std::uint32_t i = 200; i < 204; ++i) value_of(samples, i, "R") = missing;  // all of pixel 50
  Settings settings = small_settings();
  settings.box_widths = {7, 3};
  settings.clamp_negative = true;
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/noted.exr";
  write_image(path, run(samples, settings).image);
  EXPECT_EQ(std::get<std::string>(read_image(path).metadata.at("rpf:notes")),
            "samples left out: R, G or B not finite: 6 (first at pixel 3,0); "
            "pixels that lost all their samples, filled from their neighbors: 1 (first at pixel -5,2); "
            "negative radiance values, set to 0: 1 (first at pixel -7,1); "
            "samples with missing values of random.time feature.N.X: 2 (first at pixel -6,1)");
}

}  // namespace
}  // namespace rpf
