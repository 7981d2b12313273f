// The light field: what it sees, and what it refuses (lens_and_time_test.cpp has what it shares with multidim).
#include "plan/light_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lens_and_time.h"
#include "plan/tracks.h"
#include "plan/view_cells.h"
#include "rpf/error.h"
#include "rpf/metrics.h"

namespace rpf {
namespace {

using test::filtered;
using test::small_scene;

Settings settings(int views = 16) { return test::few_views("lightfield", views); }

double spread(const std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float value : values) {
    sum += value;
    squares += double{value} * value;
  }
  const auto n = static_cast<double>(values.size());
  return squares / n - sum / n * (sum / n);
}

// Of noise that a surface's samples have: 4 a pixel make up a pixel's mean, some 14 what a view sees.
TEST(LightField, AveragesTheSamplesOfASurface) {
  SampleBuffer samples = render_scene("dof", small_scene());
  test::Dice dice(9);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) test::value_of(samples, i, slot) = dice();
  EXPECT_LT(spread(filtered(samples, settings(64))), 0.6 * spread(filtered(samples, test::plain_mean())));
}

TEST(LightField, DoesNotDependOnWhereTheWorldLies) {
  SceneOptions options = small_scene(), moved = small_scene();
  moved.world_scale = 64;
  moved.world_offset = {128, -64, 32};
  const Image expected = filter(render_scene("combined", options), settings()).image;
  const Image found = filter(render_scene("combined", moved), settings()).image;
  EXPECT_LT(compare_images(found, expected).relmse, 1e-4);  // a close call of a view here and there
}

TEST(LightField, RefusesWhatItCannotBeWithout) {
  const SampleBuffer samples = render_scene("combined", small_scene());
  const auto expect_refused = [](const SampleBuffer& without, const std::string& missing) {
    try {
      filter(without, settings());
      ADD_FAILURE() << missing;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::input);
      EXPECT_NE(std::string(e.what()).find(missing), std::string::npos) << e.what();
    }
  };
  for (const char* name : {"worldToCamera", "worldToNDC", "rpf:lensRadius", "rpf:focusDistance"}) {
    SampleBuffer without = samples;
    without.metadata.erase(name);
    expect_refused(without, name);
  }
  for (const char* name : {"rpf:lensRadius", "rpf:focusDistance"}) {
    SampleBuffer wrong = samples;
    wrong.metadata[name] = -1.0F;
    expect_refused(wrong, name);
  }
  for (const Attribute& origin : {Attribute("1 2 3"), Attribute(std::vector<float>{1, 2}), Attribute(1.0F)}) {
    SampleBuffer wrong = samples;
    wrong.metadata["rpf:worldOrigin"] = origin;
    expect_refused(wrong, "rpf:worldOrigin");
  }
  for (const char* slot : {"feature.P.Y", "feature.opening.X", "feature.closing.Z"}) {
    std::vector<std::string> slots = samples.layout.slots;
    slots.erase(std::find(slots.begin(), slots.end(), slot));
    expect_refused(test::with_slots(samples, slots), slot);
  }
}

TEST(LightField, NeedsNoMotionWhereTimeIsNoParameter) {
  const SampleBuffer samples = render_scene("dof", small_scene());
  std::vector<std::string> slots;
  for (const std::string& slot : samples.layout.slots)
    if (slot != "random.time" && group_of(slot) != "opening" && group_of(slot) != "closing") slots.push_back(slot);
  EXPECT_EQ(filtered(test::with_slots(samples, slots), settings()), filtered(samples, settings()));
}

// The samples of dof-edge lie on two planes; seen through the lens's center they are where they were projected from.
TEST(LightField, SeesSamplesWhereTheCameraSawThem) {
  SceneOptions options = small_scene();
  const Settings s = settings();
  const PreparedFrame prepared = prepare(render_scene("motion", options), s);  // a pinhole
  const LightField light = make_light_field(prepared, s);
  for (std::size_t i = 0; i < light.samples(); ++i) {
    const float* record = prepared.frame.record(i);
    const float time = record[Variables::random];
    const kernel::rpf_sighting seen = kernel::rpf_sight(&light.tracks[i * RPF_TRACK], &light.field.lens, 0, 0, time);
    ASSERT_NEAR(seen.x, record[Variables::position], 1e-3) << i;
    ASSERT_NEAR(seen.y, record[Variables::position + 1], 1e-3) << i;
  }
}

TEST(ViewCells, HoldEachSampleOnce) {
  const kernel::rpf_light_field field = light_field_shape(7, 5, 3, 7 * 5 * 64);
  EXPECT_GT(field.finer, 1);
  ViewCells cells(field);
  test::Dice dice(4);
  std::vector<float> places;
  for (int i = 0; i < 500; ++i)
    for (const float value : {9 * dice() - 1, 7 * dice() - 1, dice() - 0.1F}) places.push_back(value);
  cells.sort(places);
  ASSERT_EQ(cells.first().size(), cells_of(field) + 2);
  const int columns = field.width * field.finer + 2 * field.margin;
  for (std::size_t c = 0; c < cells_of(field); ++c)
    for (std::uint32_t i = cells.first()[c]; i < cells.first()[c + 1]; ++i) {
      const float* place = &cells.places()[RPF_PLACE * std::size_t{i}];
      EXPECT_EQ(place[0], places[RPF_PLACE * cells.samples()[i]]);
      EXPECT_GT(place[2], 0);
      EXPECT_EQ(std::floor(place[0] * static_cast<float>(field.finer)) + field.margin, c % columns);
      EXPECT_EQ(std::floor(place[1] * static_cast<float>(field.finer)) + field.margin, c / columns);
    }
}

}  // namespace
}  // namespace rpf
