// Which samples a pixel of a preset's picture is made of, as pictures and a table.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/explain_maps.h"
#include "cli/explain_pages.h"
#include "cli/explain_shares.h"
#include "report/html_page.h"
#include "report/picture.h"
#include "rpf/io.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

constexpr int least_picture = 300;    ///< CSS pixels
constexpr double least_shown = 1e-4;  ///< of the largest share

report::Picture picture(const std::string& folder, const std::string& name, const Image& image,
                        const std::string& caption, const report::Legend& legend = {}) {
  const std::string file = (fs::path(folder) / (name + ".png")).string();
  write_image(file, image);
  return {file, caption, legend};
}

report::Picture share_picture(const std::string& folder, const ExplainedEstimate& estimate) {
  Image map;
  map.data_window = map.display_window = {0, 0, estimate.window.width, estimate.window.height};
  map.channels = {"Y"};
  map.pixels = estimate.shares;
  const double most = *std::max_element(map.pixels.begin(), map.pixels.end());
  const ExplainMap colored = scalar_map(map, 0, {most * least_shown, most});
  return picture(folder, "estimate-shares", report::side_by_side({colored.picture}),
                 "The share of each of these pixels in the color, logarithmic.", colored.legend);
}

report::Table summary(const ExplainedEstimate& estimate) {
  return {{"what", "value"},
          {{"network", estimate.model},
           {"plain mean R, G, B", color_text(estimate.mean)},
           {"in the preset's picture", color_text(estimate.result)},
           {"samples with a share", fmt::format("{}", estimate.samples.size())},
           {"effective samples", number(estimate.effective_samples)},
           {"albedo here over that of the samples, as far as it is used", color_text(estimate.factor)}},
          1};
}

report::Table largest_shares(const ExplainedEstimate& estimate) {
  report::Table table{{"largest shares: pixel", "R, G, B of the sample", "share"}, {}, 1};
  for (std::size_t i = 0; i < std::min(listed_shares, estimate.samples.size()); ++i) {
    const Contribution& sample = estimate.samples[i];
    table.rows.push_back(
        {fmt::format("{},{}", sample.pixel.x, sample.pixel.y), color_text(sample.color), number(sample.share)});
  }
  return table;
}

}  // namespace

void add_estimate(const std::string& folder, const Image& frame, const ExplainedEstimate& estimate,
                  report::HtmlPage& page) {
  page.heading("What made it, in the picture of " + estimate.model);
  page.paragraph(
      "The color is the mean of samples around, weighted by their shares, times what the albedo here is over theirs; "
      "docs/network.md has the formulas.");
  page.table(summary(estimate));
  Window window = estimate.window;
  window.x -= frame.data_window.x;
  window.y -= frame.data_window.y;
  page.pictures({picture(folder, "estimate-window", report::side_by_side({frame}, window),
                         "The pixels that it can be made of, and the plain mean there, enlarged."),
                 share_picture(folder, estimate)},
                least_picture);
  std::vector<float> shares;
  for (const Contribution& sample : estimate.samples) shares.push_back(sample.share);
  page.plot(share_plot(shares, "the color"), "How many samples make the color.");
  page.table(largest_shares(estimate));
}

}  // namespace rpf::cli
