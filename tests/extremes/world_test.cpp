// Places in the world and on the film (docs/stability.md, "Places").
#include <cmath>

#include "arbitrary.h"

namespace rpf {
namespace {

using namespace test;

// Positions are multiples of 256 up to 1.4 million, a scene of that size: what is added moves none of them to another
// float, and every spread stays above a millionth of the distance to the origin, below which section 4 takes it for
// rounding.
constexpr float unit = 256;
constexpr int largest_offset = (1 << 24) - 1400000;

/// Takes the position of single samples and of all samples of a pixel and its right neighbor.
void lose_positions(SampleBuffer& samples) {
  const auto pixel = static_cast<std::size_t>(*rc::gen::inRange(0, 24 * 16 - 1));
  for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 2]; ++i)
    value_of(samples, i, "feature.P.X") = NAN;
  for (int i = 0; i < 40; ++i) value_of(samples, any_sample(samples), "feature.P.Z") = NAN;
}

RC_GTEST_PROP(World, OffsetThatTheInputSurvivesKeepsEveryBit, ()) {
  SampleBuffer samples = any_frame();
  const Settings settings = any_settings();
  snap_positions(samples, unit);
  if (*rc::gen::inRange(0, 2) == 1) lose_positions(samples);
  const std::vector<float> expected = filtered(samples, settings);
  const auto any_offset = [] {
    return static_cast<float>(*rc::gen::oneOf(rc::gen::inRange(-largest_offset, largest_offset),
                                              rc::gen::element(100, -100, 10000, 10000000, -10000000, 1 << 23)));
  };
  move_world(samples, any_offset(), any_offset(), any_offset());
  RC_ASSERT(difference(filtered(samples, settings), expected, 24) == "");
}

RC_GTEST_PROP(World, UnitDoesNotMatter, ()) {
  SampleBuffer samples = any_frame();
  const Settings settings = any_settings();
  const std::vector<float> expected = filtered(samples, settings);
  const float scale = std::ldexp(1.0F, *rc::gen::inRange(-40, 41));
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"}) value_of(samples, i, slot) *= scale;
  RC_ASSERT(difference(filtered(samples, settings), expected, 24) == "");
}

RC_GTEST_PROP(DataWindow, MayLieAnywhere, ()) {
  SampleBuffer samples = any_frame();
  const Settings settings = any_settings();
  for (std::size_t i = 0; i < samples.sample_count(); ++i)  // 64ths of a pixel, which float has up to 2^18
    for (const char* slot : {"film.X", "film.Y"})
      value_of(samples, i, slot) = std::floor(value_of(samples, i, slot) * 64) / 64;
  const std::vector<float> expected = filtered(samples, settings);
  const auto any_place = [] {
    return *rc::gen::oneOf(rc::gen::inRange(-200000, 200000), rc::gen::element(-7, -3, 100000, 5));
  };
  samples.data_window.x = any_place();
  samples.data_window.y = any_place();
  samples.display_window = {any_place(), any_place(), *rc::gen::inRange(1, 5000), *rc::gen::inRange(1, 5000)};
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    value_of(samples, i, "film.X") += static_cast<float>(samples.data_window.x);
    value_of(samples, i, "film.Y") += static_cast<float>(samples.data_window.y);
  }
  const Image image = run(samples, settings).image;
  RC_ASSERT(image.data_window == samples.data_window);
  RC_ASSERT(image.display_window == samples.display_window);
  RC_ASSERT(difference(image.pixels, expected, 24) == "");
}

}  // namespace
}  // namespace rpf
