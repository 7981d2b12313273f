// Radiance of any magnitude (docs/stability.md, "Radiance").
#include <algorithm>
#include <cmath>

#include "arbitrary.h"
#include "tolerances.h"

namespace rpf {
namespace {

using namespace test;

constexpr const char* colors[] = {"R", "G", "B"};

/// Every R, G and B becomes value(i) of its sample.
template <typename Value>
void set_colors(SampleBuffer& samples, Value value) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : colors) value_of(samples, i, slot) = value();
}

// The frames' values are between 2^-5 and 2 with 24 bits, so that no power asked for here makes one subnormal: 1e-36 to
// 1e38.
RC_GTEST_PROP(Radiance, TimesAPowerOfTwoIsThePictureTimesIt, ()) {
  const SampleBuffer plain = any_frame();
  const Settings settings = any_settings();
  const int exponent = *rc::gen::inRange(-120, 127);
  SampleBuffer scaled = plain;
  scale_radiance(scaled, std::ldexp(1.0F, exponent));
  std::vector<float> expected = filtered(plain, settings);
  for (float& value : expected) value = std::ldexp(value, exponent);
  RC_ASSERT(difference(filtered(scaled, settings), expected, 24) == "");
}

// Any other factor rounds the input: where a normalized value lies on the edge of a bin, that may decide.
TEST(Radiance, TimesAnyPowerOfTenIsThePictureTimesItUpToTheRoundingOfTheInput) {
  const SampleBuffer plain = defocused_edge({24, 16, 4, 1});
  for (const Profile profile : {Profile::thesis, Profile::paper}) {
    Settings settings = small_settings();
    settings.profile = profile;
    settings.box_widths = {7, 3};
    const std::vector<float> expected = filtered(plain, settings);
    for (const float factor : {1e-30F, 1e-20F, 1e-10F, 1e10F, 1e20F, 1e30F}) {
      SampleBuffer scaled = plain;
      scale_radiance(scaled, factor);
      const std::vector<float> pixels = filtered(scaled, settings);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        ASSERT_NEAR(pixels[i] / static_cast<double>(factor), expected[i], tolerance::picture * expected[i])
            << "value " << i << " at " << factor;
    }
  }
}

RC_GTEST_PROP(Radiance, OfAllMagnitudesAtOnceStaysInsideTheHull, ()) {
  SampleBuffer samples = any_frame();
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  set_colors(samples, [&] { return any_finite_float(dice); });
  RC_ASSERT(outside_hull(filtered(samples, settings_of(Profile::thesis)), samples) == "");
}

RC_GTEST_PROP(Radiance, OfAllMagnitudesAtOnceStaysFiniteInThePaperProfile, ()) {
  SampleBuffer samples = any_frame();
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  set_colors(samples, [&] { return any_finite_float(dice); });
  RC_ASSERT(not_finite(filtered(samples, settings_of(Profile::paper))) == "");
}

RC_GTEST_PROP(Radiance, OfTheExamplesStaysInsideTheHull, ()) {
  const SampleBuffer samples = any_frame();
  RC_ASSERT(outside_hull(filtered(samples, settings_of(Profile::thesis)), samples) == "");
}

// Channels may be 2^120 apart: more than 2^166 below the brightest the frame's scale would make a value subnormal.
RC_GTEST_PROP(Radiance, ThatIsConstantComesBackExactly, ()) {
  SampleBuffer samples = any_uniform_frame();
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  const float brightest = *rc::gen::inRange(0, 4) == 0 ? 0.0F : any_finite_float(dice);
  std::vector<float> expected = {brightest, std::ldexp(brightest, *rc::gen::inRange(-120, 0)) + 0.0F, 0.0F - brightest};
  for (std::size_t c = 0; c < 3; ++c) fill(samples, colors[c], expected[c]);
  while (expected.size() < 3 * samples.data_window.pixel_count()) expected.push_back(expected[expected.size() - 3]);
  RC_ASSERT(difference(filtered(samples, any_settings()), expected, 24) == "");
}

RC_GTEST_PROP(Radiance, ThatIsNegativeIsKeptAndCountedOrClamped, ()) {
  SampleBuffer samples = any_frame(), clamped = samples;
  Settings settings = any_settings();
  const std::uint32_t step = static_cast<std::uint32_t>(*rc::gen::inRange(2, 300));
  std::uint64_t count = 0;
  for (std::uint32_t i = step / 2; i < samples.sample_count(); i += step, ++count) {
    value_of(samples, i, "B") = -value_of(samples, i, "B");
    value_of(clamped, i, "B") = 0;
  }
  const Result kept = run(samples, settings);
  const auto note = std::find_if(kept.report.notes.begin(), kept.report.notes.end(),
                                 [](const InputNote& n) { return n.what == "negative radiance values, kept"; });
  RC_ASSERT(note != kept.report.notes.end());
  RC_ASSERT(note->count == count);
  RC_ASSERT(note->y * 24 + note->x == pixel_of(samples, step / 2));
  RC_ASSERT(not_finite(kept.image.pixels) == "");
  const std::vector<float> expected = filtered(clamped, settings);
  settings.clamp_negative = true;
  RC_ASSERT(difference(filtered(samples, settings), expected, 24) == "");
}

}  // namespace
}  // namespace rpf
