#include "run/pass_summary.h"

#include <algorithm>

namespace rpf {

void PassSummary::add(const std::vector<PixelStatistics>& statistics, const Frame& frame, const Window& part) {
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * frame.width + x;
      const PixelStatistics& s = statistics[pixel];
      if (s.neighbors == 0) continue;
      ++pixels_;
      drawn_ += s.drawn;
      accepted_ += s.neighbors - frame.samples(pixel);
      neighbors_ += s.neighbors;
      fraction_random_ += s.fraction_random;
      alpha_ += s.alpha;
      beta_ += s.beta;
    }
}

PassReport PassSummary::report(const PassPlan& pass) const {
  PassReport report;
  const double n = std::max(pixels_, 1.0);
  report.box_width = pass.box_width;
  report.acceptance = drawn_ > 0 ? accepted_ / drawn_ : 0;
  report.neighbors = neighbors_ / n;
  report.fraction_random = fraction_random_ / n;
  report.alpha = alpha_ / n;
  report.beta = beta_ / n;
  return report;
}

PassReport summarize(const std::vector<PixelStatistics>& statistics, const Frame& frame, const PassPlan& pass) {
  PassSummary summary;
  summary.add(statistics, frame, pass.region);
  return summary.report(pass);
}

}  // namespace rpf
