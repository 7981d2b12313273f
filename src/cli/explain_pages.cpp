#include "cli/explain_pages.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/explain_maps.h"
#include "cli/print.h"
#include "report/html_page.h"
#include "report/picture.h"
#include "rpf/io.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

constexpr int least_picture = 340;  ///< CSS pixels

std::string path_in(const std::string& folder, const std::string& file) { return (fs::path(folder) / file).string(); }

report::Table settings_table(const std::string& input, const Explanation& explanation) {
  const Report& report = explanation.report;
  const PassReport& pass = report.passes.front();
  return {
      {"what", "value"},
      {{"file", fs::path(input).filename().string()},
       {"pixels", fmt::format("{} x {}", explanation.layers.data_window.width, explanation.layers.data_window.height)},
       {"random parameters", listed(report.random)},
       {"features", listed(report.features)},
       {"constant, not modeled", listed(report.dropped)},
       {"box width of the pass", fmt::format("{}", pass.box_width)},
       {"backend", report.backend}},
      2};
}

report::Table numbers_table(const Image& layers) {
  report::Table table{{"layer of explain.exr", "least", "median", "95 %", "largest", "mean"}, {}, 1};
  for (std::size_t c = 0; c < layers.channel_count(); ++c) {
    const std::vector<float> values = sorted_values(layers, c);
    double sum = 0;
    for (const float value : values) sum += value;
    const auto at = [&](double part) {
      return fmt::format("{:.4g}", values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))]);
    };
    table.rows.push_back({layers.channels[c], at(0), at(0.5), at(0.95), at(1),
                          fmt::format("{:.4g}", sum / static_cast<double>(values.size()))});
  }
  return table;
}

/// Writes the pictures and shows them, each chapter under its heading.
void add_maps(const std::string& folder, const Explanation& explanation, report::HtmlPage& page) {
  std::string chapter;
  std::vector<report::Picture> pictures;
  const auto end_chapter = [&] {
    if (pictures.empty()) return;
    page.heading(chapter);
    page.pictures(pictures, least_picture);
    pictures.clear();
  };
  for_each_map(explanation, [&](const ExplainMap& map) {
    if (map.chapter != chapter) end_chapter();
    chapter = map.chapter;
    const std::string file = path_in(folder, map.name + ".png");
    write_image(file, report::side_by_side({map.picture}));
    pictures.push_back({file, map.reading, map.legend});
  });
  end_chapter();
}

}  // namespace

void write_explanation(const std::string& folder, const std::string& input, const Explanation& explanation) {
  write_image(path_in(folder, "explain.exr"), explanation.layers);
  write_image(path_in(folder, "density.exr"), part_of(explanation.layers, "density", {"Y"}));
  report::HtmlPage page("What the filter thinks of " + fs::path(input).filename().string());
  page.paragraph(
      "One pass of the filter, pixel by pixel. Every picture is a layer of explain.exr beside this page; "
      "docs/explain.md "
      "has the formulas and how far to trust them.");
  page.table(settings_table(input, explanation));
  add_maps(folder, explanation, page);
  page.heading("Numbers");
  page.table(numbers_table(explanation.layers));
  if (explanation.pixel) {
    const PixelPosition& at = explanation.pixel->position;
    page.link(pixel_page_name(at) + ".html", fmt::format("Pixel {},{}", at.x, at.y));
  }
  page.write(path_in(folder, "index.html"));
}

}  // namespace rpf::cli
