// The light field: what must not matter, what it is for, and what it refuses.
#include "plan/light_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plan/tracks.h"
#include "plan/view_cells.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "rpf/metrics.h"
#include "rpf/scene.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

SceneOptions small(int samples = 4) {
  SceneOptions options;
  options.width = 40;
  options.height = 24;
  options.samples = samples;
  options.lightfield = true;
  options.threads = 1;
  return options;
}

Settings settings(int views = 16) {
  Settings s = method_settings("lightfield");
  s.backend = test::backend_under_test();
  s.threads = 1;
  s.views = views;
  return s;
}

std::vector<float> filtered(const SampleBuffer& samples, const Settings& s) { return filter(samples, s).image.pixels; }

TEST(LightField, GivesTheSameBitsForThreadsAndRuns) {
  SceneOptions options = small();
  options.adaptive = true;
  const SampleBuffer samples = render_scene("combined", options);
  const std::vector<float> expected = filtered(samples, settings());
  Settings s = settings();
  s.threads = 3;
  EXPECT_EQ(filtered(samples, s), expected);
  s.backend = "cpu";
  EXPECT_EQ(filtered(samples, s), expected);
}

TEST(LightField, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = render_scene("combined", small());
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = filter(samples, settings()).image;
  EXPECT_EQ(filter(samples, crop).image.pixels, test::part_of(whole, *crop.crop));
}

TEST(LightField, ScalesWithRadiance) {
  const SampleBuffer samples = render_scene("combined", small());
  SampleBuffer scaled = samples;
  test::scale_radiance(scaled, std::ldexp(1.0F, -90));
  std::vector<float> expected = filtered(samples, settings());
  for (float& value : expected) value = std::ldexp(value, -90);
  EXPECT_EQ(filtered(scaled, settings()), expected);
}

TEST(LightField, LeavesASingleColorWhatItIs) {
  SampleBuffer samples = render_scene("combined", small());
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.3F);
  for (const float value : filtered(samples, settings())) ASSERT_EQ(value, 0.3F);
}

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
  SampleBuffer samples = render_scene("dof", small());
  test::Dice dice(9);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) test::value_of(samples, i, slot) = dice();
  Settings plain = settings();
  plain.method = Method::rpf;
  plain.box_widths.clear();
  EXPECT_LT(spread(filtered(samples, settings(64))), 0.6 * spread(filtered(samples, plain)));
}

TEST(LightField, LeavesPixelsWithoutSamplesBlack) {
  SceneOptions options = small(1);
  options.adaptive = true;
  const SampleBuffer samples = render_scene("dof", options);
  const Image image = filter(samples, settings()).image;
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    if (samples.first_sample[p] == samples.first_sample[p + 1]) {
      ASSERT_EQ(image.pixel(p)[0], 0);
    }
}

TEST(LightField, DoesNotDependOnWhereTheWorldLies) {
  SceneOptions options = small(), moved = small();
  moved.world_scale = 64;
  moved.world_offset = {128, -64, 32};
  const Image expected = filter(render_scene("combined", options), settings()).image;
  const Image found = filter(render_scene("combined", moved), settings()).image;
  EXPECT_LT(compare_images(found, expected).relmse, 1e-4);  // a close call of a view here and there
}

// Where all noise is of lens or time, hardly any is left; of so small a picture of motion half the plain mean's error,
// because what is sharp gets averaged too.
TEST(LightField, TakesAwayTheNoiseOfLensAndTime) {
  for (const auto& [scene, part] : {std::pair{"dof-edge", 0.4}, std::pair{"motion", 0.6}}) {
    SceneOptions options = small(64);
    const Image reference = render_reference(scene, options);
    const SampleBuffer samples = render_scene(scene, small());
    Settings plain = settings();
    plain.method = Method::rpf;
    plain.box_widths.clear();
    const double before = compare_images(filter(samples, plain).image, reference).relmse;
    const double after = compare_images(filter(samples, settings(64)).image, reference).relmse;
    EXPECT_LT(after, part * before) << scene;
  }
}

TEST(LightField, RefusesWhatItCannotBeWithout) {
  const SampleBuffer samples = render_scene("combined", small());
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
  for (const char* slot : {"feature.P.Y", "feature.opening.X", "feature.closing.Z"}) {
    std::vector<std::string> slots = samples.layout.slots;
    slots.erase(std::find(slots.begin(), slots.end(), slot));
    expect_refused(test::with_slots(samples, slots), slot);
  }
}

TEST(LightField, NeedsNoMotionWhereTimeIsNoParameter) {
  const SampleBuffer samples = render_scene("dof", small());
  std::vector<std::string> slots;
  for (const std::string& slot : samples.layout.slots)
    if (slot != "random.time" && group_of(slot) != "opening" && group_of(slot) != "closing") slots.push_back(slot);
  EXPECT_EQ(filtered(test::with_slots(samples, slots), settings()), filtered(samples, settings()));
}

// The samples of dof-edge lie on two planes; seen through the lens's center they are where they were projected from.
TEST(LightField, SeesSamplesWhereTheCameraSawThem) {
  SceneOptions options = small();
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
