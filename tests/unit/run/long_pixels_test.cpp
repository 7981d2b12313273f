// A pixel of very many samples takes minutes; stopping does not. In the suite Filter, so that both backends run it.
#include <gtest/gtest.h>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf {
namespace {

SampleBuffer one_long_pixel(std::uint32_t count) {
  SampleBuffer samples;
  samples.data_window = samples.display_window = {0, 0, 1, 1};
  samples.layout.slots = {"R", "G", "B", "film.X", "film.Y", "random.lens.U", "feature.N.X"};
  test::Dice dice(1);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float u = dice();
    samples.values.insert(samples.values.end(), {u, 1 - u, dice(), dice(), dice(), u, dice()});
  }
  samples.first_sample = {0, count};
  return samples;
}

TEST(Filter, StopsInTheMiddleOfALongPixel) {  // to its end it would take longer than a test may
  Settings settings = test::small_settings();
  settings.box_widths = {3};
  for (const Method method : {Method::rpf, Method::bilateral}) {
    settings.method = method;
    int calls = 0;
    Control control;
    control.progress = [&](const Progress&) { return ++calls < 3; };
    try {
      filter(one_long_pixel(1 << 20), settings, control);
      FAIL() << "not cancelled";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::cancelled);
    }
    EXPECT_EQ(calls, 3);
  }
}

}  // namespace
}  // namespace rpf
