// The light field and columns of pixels: what must not matter to either, and what both are for.
#include "lens_and_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rpf/metrics.h"

namespace rpf {
namespace {

using test::filtered;
using test::small_scene;

struct MethodUnderTest {
  const char* name;
  /// Of the plain mean's error, at most left of so small a picture of motion: what is sharp gets averaged too, and its
  /// pixels are large. Measured: 0.5 and 0.6.
  double of_motion;
};

void PrintTo(const MethodUnderTest& method, std::ostream* to) { *to << method.name; }

class LensAndTime : public testing::TestWithParam<MethodUnderTest> {
 protected:
  static Settings settings(int views = 16) { return test::few_views(GetParam().name, views); }
};

INSTANTIATE_TEST_SUITE_P(Methods, LensAndTime,
                         testing::Values(MethodUnderTest{"lightfield", 0.6}, MethodUnderTest{"multidim", 0.7}));

TEST_P(LensAndTime, GivesTheSameBitsForThreadsAndBackends) {
  SceneOptions options = small_scene();
  options.adaptive = true;
  const SampleBuffer samples = render_scene("combined", options);
  const std::vector<float> expected = filtered(samples, settings());
  Settings s = settings();
  s.threads = 3;
  EXPECT_EQ(filtered(samples, s), expected);
  s.backend = "cpu";
  EXPECT_EQ(filtered(samples, s), expected);
}

TEST_P(LensAndTime, GivesTheSamePixelsForACrop) {
  const SampleBuffer samples = render_scene("combined", small_scene());
  Settings crop = settings();
  crop.crop = Window{17, 11, 6, 5};
  const Image whole = filter(samples, settings()).image;
  EXPECT_EQ(filter(samples, crop).image.pixels, test::part_of(whole, *crop.crop));
}

TEST_P(LensAndTime, ScalesWithRadiance) {
  const SampleBuffer samples = render_scene("combined", small_scene());
  SampleBuffer scaled = samples;
  test::scale_radiance(scaled, std::ldexp(1.0F, -90));
  std::vector<float> expected = filtered(samples, settings());
  for (float& value : expected) value = std::ldexp(value, -90);
  EXPECT_EQ(filtered(scaled, settings()), expected);
}

TEST_P(LensAndTime, LeavesASingleColorWhatItIs) {
  SampleBuffer samples = render_scene("combined", small_scene());
  for (const char* slot : {"R", "G", "B"}) test::fill(samples, slot, 0.3F);
  for (const float value : filtered(samples, settings())) ASSERT_EQ(value, 0.3F);
}

TEST_P(LensAndTime, LeavesPixelsWithoutSamplesBlack) {
  SceneOptions options = small_scene(1);
  options.adaptive = true;
  const SampleBuffer samples = render_scene("dof", options);
  const Image image = filter(samples, settings()).image;
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    if (samples.first_sample[p] == samples.first_sample[p + 1]) {
      ASSERT_EQ(image.pixel(p)[0], 0);
    }
}

// Where all noise is of lens or time, most of it goes.
TEST_P(LensAndTime, TakesAwayTheirNoise) {
  for (const auto& [scene, part] : {std::pair{"dof-edge", 0.4}, std::pair{"motion", GetParam().of_motion}}) {
    const Image reference = render_reference(scene, small_scene(64));
    const SampleBuffer samples = render_scene(scene, small_scene());
    const double before = compare_images(filter(samples, test::plain_mean()).image, reference).relmse;
    const double after = compare_images(filter(samples, settings(64)).image, reference).relmse;
    EXPECT_LT(after, part * before) << scene;
  }
}

}  // namespace
}  // namespace rpf
