#include "cli/explain_shares.h"

#include <fmt/format.h>

#include "report/plot.h"

namespace rpf::cli {
namespace {

constexpr std::size_t most_points = 1000;  ///< of a curve: more cannot be seen, and take the page seconds

}  // namespace

std::string number(float value) { return fmt::format("{:.4g}", value); }

std::string color_text(const std::array<float, 3>& c) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", c[0], c[1], c[2]);
}

std::string share_plot(const std::vector<float>& shares, const std::string& of) {
  report::Plot plot;
  plot.x_label = "samples, by falling share";
  plot.y_label = "share in " + of;
  plot.curves.push_back({"so many samples together", {}});
  const std::size_t apart = shares.size() / most_points + 1;
  double sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    sum += shares[i];
    if (i % apart == 0 || i + 1 == shares.size()) plot.curves[0].points.push_back({static_cast<double>(i + 1), sum});
  }
  return report::svg_of(plot);
}

}  // namespace rpf::cli
