// How tiles are cut into launches, and that long pixels give the same bits however they are cut.
#include "opencl/launch_work.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cpu/cpu_backend.h"
#include "frame/prepare.h"
#include "opencl/opencl_backend.h"
#include "rpf/methods.h"
#include "test_frames.h"

namespace rpf {
namespace {

/// A small frame in which one pixel has many samples, one none, and the others few.
SampleBuffer frame_with_a_long_pixel(std::uint32_t samples) {
  const SampleBuffer edge = test::defocused_edge({9, 7, 3, 1});
  SampleBuffer result = edge;
  result.values.clear();
  result.first_sample = {0};
  test::Dice dice(7);
  for (std::size_t pixel = 0; pixel < edge.data_window.pixel_count(); ++pixel) {
    const std::uint32_t count = pixel == 30 ? samples : pixel == 12 ? 0 : 3;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float* record = edge.record(edge.first_sample[pixel] + i % 3);
      for (std::size_t v = 0; v < edge.layout.size(); ++v)
        result.values.push_back(v == 3 || v == 4 ? record[v] : record[v] + dice() / 8);  // film.X, film.Y stay
    }
    result.first_sample.push_back(result.first_sample.back() + count);
  }
  return result;
}

TEST(LaunchWork, HalvesAreTheTile) {
  for (const Window& tile :
       {Window{0, 0, 2, 1}, Window{3, 5, 1, 2}, Window{0, 0, 16, 16}, Window{5, 0, 20, 8}, Window{1, 1, 7, 7}}) {
    const auto [a, b] = halves_of(tile);
    EXPECT_EQ(a.pixel_count() + b.pixel_count(), tile.pixel_count());
    EXPECT_GT(a.pixel_count(), 0U);
    EXPECT_GT(b.pixel_count(), 0U);
    EXPECT_TRUE(b.x > a.x ? b.x == a.x + a.width && b.y == a.y : b.y == a.y + a.height && b.x == a.x);
  }
}

TEST(LaunchWork, CountsWhatIsThere) {
  const SampleBuffer samples = frame_with_a_long_pixel(700);
  Settings settings;
  settings.box_widths = {3};
  settings.method = Method::bilateral;
  const PreparedFrame prepared = prepare(samples, settings);
  const Plan plan = make_plan(prepared.facts, settings);
  EXPECT_EQ(pixel_work(prepared.frame, plan, 0, 3, 3).weights(), 512U * (700 + 8 * 3));  // of a group
  EXPECT_EQ(pixel_work(prepared.frame, plan, 0, 0, 0).weights(), 3U * 4 * 3);            // the box ends at the frame
  EXPECT_EQ(pixel_work(prepared.frame, plan, 0, 3, 1).weights(), 0U);                    // no samples
  EXPECT_TRUE(has_long_pixels(plan, 512 * 700));
  EXPECT_FALSE(has_long_pixels(plan, std::uint64_t{512} * plan.passes[0].max_neighbors));
  EXPECT_EQ(most_work(prepared.frame, plan, 0, {0, 0, 9, 7}).own, 700U);
  EXPECT_GT(work_of(prepared.frame, plan, 0, {0, 0, 9, 7}), 512U * 724);
}

struct Case {
  const char* name;
  Method method;
  Profile profile;
  bool explain;
};

class LongPixels : public testing::TestWithParam<Case> {};

TEST_P(LongPixels, AreTheSameBitsHoweverTheyAreCut) {
  Settings settings = method_settings(name_of(GetParam().method));
  settings.method = GetParam().method;
  settings.profile = GetParam().profile;
  settings.box_widths = {5};
  const PreparedFrame prepared = prepare(frame_with_a_long_pixel(700), settings);
  Plan plan = make_plan(prepared.facts, settings);
  plan.explain = GetParam().explain;
  const Window all{0, 0, 9, 7};
  CpuBackend reference(1);
  reference.load(prepared.frame, prepared.colors, plan);
  reference.run(0, all);
  for (const std::uint64_t weights_at_once : {std::uint64_t{1} << 40, std::uint64_t{100000}, std::uint64_t{3000}}) {
    OpenClOptions options;
    options.threads = 2;
    options.weights_at_once = weights_at_once;
    OpenClBackend device(options);
    int checks = 0;
    device.watch([&] { ++checks; });
    device.load(prepared.frame, prepared.colors, plan);
    device.run(0, all);
    EXPECT_EQ(device.explained(), reference.explained());
    for (std::size_t pixel = 0; pixel < 63; ++pixel) {
      EXPECT_EQ(device.statistics()[pixel].neighbors, reference.statistics()[pixel].neighbors) << pixel;
      EXPECT_EQ(device.statistics()[pixel].beta, reference.statistics()[pixel].beta) << pixel;
    }
    const auto parts = static_cast<int>(512 * 700 / weights_at_once);
    EXPECT_GE(checks, std::max(parts, 1));
    device.end_pass();
    CpuBackend again(2);
    again.load(prepared.frame, prepared.colors, plan);
    again.run(0, all);
    again.end_pass();
    EXPECT_EQ(device.colors(), again.colors()) << weights_at_once;
  }
}

INSTANTIATE_TEST_SUITE_P(, LongPixels,
                         testing::Values(Case{"thesis", Method::rpf, Profile::thesis, false},
                                         Case{"outliers", Method::rpf, Profile::paper, false},
                                         Case{"explained", Method::rpf, Profile::paper, true},
                                         Case{"bilateral", Method::bilateral, Profile::thesis, false},
                                         Case{"cross", Method::cross_bilateral, Profile::thesis, false}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace rpf
