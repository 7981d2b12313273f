// Columns of pixels in the space of the samples: the tree, and what is of them alone (lens_and_time_test.cpp has the
// rest).
#include "plan/pixel_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lens_and_time.h"

namespace rpf {
namespace {

using test::filtered;
using test::small_scene;

std::vector<float> any_places(std::size_t count, test::Dice& dice) {
  std::vector<float> places;
  for (std::size_t i = 0; i < count * RPF_DIMENSIONS; ++i) places.push_back(9 * dice());
  return places;
}

TEST(SampleTree, HoldsEachSampleOnceWhereItStands) {
  test::Dice dice(3);
  for (const std::size_t count : {1, 4, 5, 63, 1000}) {
    std::vector<float> places = any_places(count, dice);
    const SampleTree tree = make_sample_tree(places);
    std::vector<std::uint32_t> samples = tree.samples;
    std::sort(samples.begin(), samples.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(samples, all);
    for (std::uint32_t leaf = 0; leaf < tree.leaves; ++leaf) ASSERT_LE(tree.first[leaf + 1] - tree.first[leaf], 4U);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_TRUE(std::equal(tree.place(i), tree.place(i) + RPF_DIMENSIONS, &places[tree.samples[i] * RPF_DIMENSIONS]));
  }
}

TEST(SampleTree, LeavesOutWhatHasNoPlace) {
  test::Dice dice(4);
  std::vector<float> places = any_places(9, dice);
  places[3] = NAN;
  places[2 * RPF_DIMENSIONS] = INFINITY;
  const SampleTree tree = make_sample_tree(places);
  EXPECT_EQ(tree.samples.size(), 7U);
  EXPECT_EQ(std::count(tree.samples.begin(), tree.samples.end(), 0U), 0);
  EXPECT_EQ(make_sample_tree({NAN, 0, 0, 0, 0}).leaves, 0U);
}

TEST(SampleTree, FindsTheNearest) {
  test::Dice dice(5);
  const SampleTree tree = make_sample_tree(any_places(700, dice));
  for (int turn = 0; turn < 50; ++turn) {
    ColumnPlace place;
    for (double& x : place) x = 11 * dice() - 1;
    const auto distance = [&](std::uint32_t i) {
      double sum = 0;
      for (std::size_t k = 0; k < RPF_DIMENSIONS; ++k) sum += std::pow(tree.place(i)[k] - place[k], 2);
      return sum;
    };
    std::vector<std::uint32_t> expected(tree.samples.size());
    std::iota(expected.begin(), expected.end(), 0);
    std::sort(expected.begin(), expected.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    expected.resize(17);
    std::vector<std::uint32_t> found = nearest_samples(tree, place, 17);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }
}

Settings settings(int views = 16) { return test::few_views("multidim", views); }

TEST(PixelColumns, StayWithinTheSamples) {
  const SampleBuffer samples = render_scene("combined", small_scene());
  const std::vector<float> pixels = filtered(samples, settings());
  for (std::size_t c = 0; c < 3; ++c) {
    float least = INFINITY, most = -INFINITY;
    for (std::size_t i = 0; i < samples.sample_count(); ++i) {
      const float value = samples.record(i)[*samples.layout.find(std::string(1, "RGB"[c]))];
      least = std::min(least, value);
      most = std::max(most, value);
    }
    for (std::size_t i = c; i < pixels.size(); i += 3) {
      ASSERT_GE(pixels[i], least);
      ASSERT_LE(pixels[i], most);
    }
  }
}

// All samples of a pixel in one place, and many of them: a search ends all the same.
TEST(PixelColumns, EndWhereAllSamplesAreInOnePlace) {
  SceneOptions options = small_scene(64);
  options.width = options.height = 8;
  SampleBuffer samples = render_scene("combined", options);
  for (const char* slot : {"random.lens.U", "random.lens.V", "random.time"}) test::fill(samples, slot, 0.5F);
  for (const float value : filtered(samples, settings())) ASSERT_TRUE(std::isfinite(value));
}

TEST(PixelColumns, TakeWhatDimensionsThereAre) {
  const SampleBuffer samples = render_scene("dof", small_scene());
  std::vector<std::string> slots;
  for (const std::string& slot : samples.layout.slots)
    if (slot != "random.time") slots.push_back(slot);
  EXPECT_EQ(filtered(test::with_slots(samples, slots), settings()), filtered(samples, settings()));
}

}  // namespace
}  // namespace rpf
