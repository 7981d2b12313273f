#include "study/work.h"

namespace rpf::study {
namespace {

double pixels(const bench::SweepFrame& frame) { return static_cast<double>(frame.width) * frame.height; }

}  // namespace

double rendering_work(const bench::SweepFrame& frame, int samples_per_pixel) {
  return 0.6 * pixels(frame) * samples_per_pixel;
}

// Microseconds a pixel and pass: what pairs of variables cost, and what draws and their weights do (docs/bench.md).
double filtering_work(const bench::SweepFrame& frame, const Settings& settings) {
  const double per_pixel = settings.profile == Profile::paper ? 0.5 * frame.samples_per_pixel : 0.5;
  double work = 2;  // comparing and writing
  for (const int width : settings.box_widths) {
    const double draws = settings.samples_factor.value_or(per_pixel) * width * width;
    work += 3 + draws * (0.02 + 0.0005 * frame.samples_per_pixel);
  }
  return work * pixels(frame);
}

}  // namespace rpf::study
