// The extremes together, the reference against the device, and against the plain scene.
#include <algorithm>
#include <cmath>
#include <limits>

#include "arbitrary.h"
#include "rpf/methods.h"
#include "rpf/scene.h"
#include "tolerances.h"

namespace rpf {
namespace {

using namespace test;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float far_away = 1e7F;

/// Far from the origin, of any brightness, with values that are none.
SampleBuffer any_extreme_frame() {
  SampleBuffer samples = any_frame();
  scale_radiance(samples, static_cast<float>(std::pow(10.0, *rc::gen::inRange(-44, 38))));
  move_world(samples, far_away, -far_away, 0);
  for (int bad = 0; bad < 20; ++bad) {
    const std::string slot = *rc::gen::elementOf(
        std::vector<std::string>{"R", "B", "film.X", "random.time", "feature.N.X", "feature.albedo.R"});
    value_of(samples, any_sample(samples), slot) = *rc::gen::element(-1e30F, infinity, NAN, 1e-42F, -0.0F, 1e30F);
  }
  return samples;
}

/// Shadows of any width, with values that none can have.
void cast_extreme_shadows(SampleBuffer& samples) {
  cast_shadows(samples);
  for (int bad = 0; bad < 20; ++bad) {
    const std::string slot = *rc::gen::element<std::string>("feature.penumbra.slope", "feature.penumbra.width");
    value_of(samples, any_sample(samples), slot) = *rc::gen::element(-1.0F, infinity, NAN, 1e-42F, 1e15F, 1e30F);
  }
}

/// A camera that looks along z from before the frame, and surfaces that move anywhere, some to where nothing can be.
void move_extremely(SampleBuffer& samples) {
  for (const char* group : {"feature.opening.", "feature.closing."})
    for (const char* axis : {"X", "Y", "Z"}) {
      add_channel(samples, std::string(group) + axis, 0);
      for (std::size_t i = 0; i < samples.sample_count(); ++i)
        value_of(samples, i, std::string(group) + axis) =
            value_of(samples, i, std::string("feature.P.") + axis) + static_cast<float>(i % 5) - 2;
    }
  for (int bad = 0; bad < 20; ++bad) {
    const std::string slot = *rc::gen::element<std::string>("feature.P.X", "feature.P.Z", "feature.opening.Y",
                                                            "feature.closing.Z", "random.time");
    value_of(samples, any_sample(samples), slot) = *rc::gen::element(-1.0F, infinity, NAN, 1e-42F, 1e15F, 1e30F);
  }
  const float away = *rc::gen::element(0.0F, 5.0F, 1e6F);
  samples.metadata["worldToCamera"] =
      std::vector<float>{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, -far_away, -far_away, away, 1};
  samples.metadata["worldToNDC"] = std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, -far_away, far_away, 1, away};
  samples.metadata["rpf:lensRadius"] = *rc::gen::element(0.0F, 1e-6F, 0.3F, 1e6F);
  samples.metadata["rpf:focusDistance"] = *rc::gen::element(1e-6F, 3.0F, 1e6F);
}

RC_GTEST_PROP(Backends, GiveTheSameBitsAtAllExtremesTogether, ()) {
  if (backend_under_test() == "cpu") RC_SUCCEED("this is the reference");
  const SampleBuffer samples = any_extreme_frame();
  Settings settings = any_settings();
  const std::vector<float> device = filtered(samples, settings);
  settings.backend = "cpu";
  RC_ASSERT(difference(device, filter(samples, settings).image.pixels, 24) == "");
}

RC_GTEST_PROP(Backends, FilterPixelsToTheSameFiniteBitsAtAllExtremesTogether, ()) {
  SampleBuffer samples = any_extreme_frame();
  Settings settings = method_settings(*rc::gen::element<std::string>("nlm", "gem", "sbf", "axis-aligned"));
  settings.backend = backend_under_test();
  if (settings.method == Method::axis_aligned) cast_extreme_shadows(samples);
  const std::vector<float> found = filtered(samples, settings);
  RC_ASSERT(not_finite(found) == "");
  settings.backend = "cpu";
  RC_ASSERT(difference(found, filter(samples, settings).image.pixels, 24) == "");
}

RC_GTEST_PROP(Backends, SeeTheSameFiniteBitsAtAllExtremesTogether, ()) {
  SampleBuffer samples = any_extreme_frame();
  move_extremely(samples);
  Settings settings = method_settings(*rc::gen::element<std::string>("lightfield", "multidim"));
  settings.backend = backend_under_test();
  settings.views = 5;
  const std::vector<float> found = filtered(samples, settings);
  RC_ASSERT(not_finite(found) == "");
  settings.backend = "cpu";
  RC_ASSERT(difference(found, filter(samples, settings).image.pixels, 24) == "");
}

class PlainScene : public testing::TestWithParam<const char*> {};

// The other scenes pass too; these four have skies, missing second hits, moving and blurred edges.
INSTANTIATE_TEST_SUITE_P(Scenes, PlainScene, testing::Values("dof", "motion", "menger", "combined"),
                         [](const auto& scene) { return std::string(scene.param); });

constexpr const char* places[] = {"feature.P.X",  "feature.P.Y",  "feature.P.Z",
                                  "feature.P2.X", "feature.P2.Y", "feature.P2.Z"};

/// A scene 65,536 times as large, its positions multiples of 256: 1e7 away, where float counts in ones, every spread is
/// still more than a millionth of the magnitude, or none (section 4).
SampleBuffer rounded_scene(const std::string& name) {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  SampleBuffer samples = render_scene(name, options);
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : places) value_of(samples, i, slot) = std::round(value_of(samples, i, slot) * 256) * 256;
  return samples;
}

/// Values of the picture that are further from factor * expected than rounding explains.
int different_values(const std::vector<float>& pixels, const std::vector<float>& expected, float factor) {
  int count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    count +=
        std::fabs(pixels[i] / static_cast<double>(factor) - expected[i]) <= tolerance::picture * expected[i] ? 0 : 1;
  return count;
}

// 2^100 is 1.3e30. Times a power of ten the input is rounded: where a value lies on the edge of a bin, that may decide.
TEST_P(PlainScene, HasTheSamePictureFarAwayAndAtAnyRadiance) {
  const SampleBuffer plain = rounded_scene(GetParam());
  SampleBuffer far = plain;
  for (std::size_t i = 0; i < far.sample_count(); ++i)
    for (const char* slot : places) value_of(far, i, slot) += far_away;
  for (const Profile profile : {Profile::thesis, Profile::paper}) {
    Settings settings = small_settings();
    settings.profile = profile;
    settings.box_widths = {7, 3};
    const std::vector<float> expected = filtered(plain, settings);
    EXPECT_EQ(difference(filtered(far, settings), expected, 24), "");
    for (const float factor : {0x1p-100F, 1e-30F, 1e30F, 0x1p100F}) {
      SampleBuffer scaled = far;
      scale_radiance(scaled, factor);
      const bool is_exact = factor == 0x1p-100F || factor == 0x1p100F;
      EXPECT_LE(different_values(filtered(scaled, settings), expected, factor),
                is_exact ? 0 : tolerance::rounded_values)
          << factor;
    }
  }
}

}  // namespace
}  // namespace rpf
