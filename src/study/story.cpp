#include "study/story.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "report/picture.h"
#include "report/text_file.h"
#include "rpf/io.h"
#include "rpf/version.h"

namespace rpf::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

std::string number(double value) {
  if (!std::isfinite(value)) return "-";
  return std::abs(value) >= 0.001 ? fmt::format("{:.3g}", value) : fmt::format("{:.2g}", value);
}

std::string verdict_of(bool holds) { return holds ? "holds" : "does not hold"; }

std::string verdict_of(std::size_t holding, std::size_t all, const char* what) {
  if (holding == all || holding == 0) return verdict_of(holding == all);
  return fmt::format("holds on {} of {} {}", holding, all, what);
}

Story::Story(const Experiment& experiment, const Extent& extent, const Findings& findings, std::string pictures)
    : findings_(findings),
      quick_(extent.quick),
      pictures_(std::move(pictures)),
      page_(fmt::format("rpf study {}", experiment.name)) {
  json_ = {{"study", experiment.name}, {"question", experiment.question}, {"version", version()},
           {"width", extent.width},    {"height", extent.height},         {"reference_spp", extent.reference_samples},
           {"quick", extent.quick},    {"verdicts", Json::array()},       {"values", Json::object()},
           {"runs", Json::array()}};
  page_.paragraph(
      fmt::format("{}{}.", static_cast<char>(std::toupper(experiment.question[0])), experiment.question + 1));
  page_.paragraph(fmt::format(
      "{}x{} pixels{}. Errors are those of rpf compare against references of {} samples a pixel: relMSE is the mean of "
      "(a - b)² / (b² + 0.01). Energy is that of the image over the plain mean's. CPU seconds are those of filtering.",
      extent.width, extent.height, extent.quick ? ", the quick form with fewer points" : "", extent.reference_samples));
}

void Story::verdicts(const std::vector<Verdict>& verdicts) {
  report::Table table{{"statement", "measured", "verdict"}, {}, 3};
  for (const Verdict& v : verdicts) {
    table.rows.push_back({v.statement, v.measured, v.verdict});
    json_["verdicts"].push_back({{"statement", v.statement}, {"measured", v.measured}, {"verdict", v.verdict}});
  }
  page_.heading("What is said, and what was measured");
  page_.table(table);
}

void Story::runs(const Outcomes& outcomes, const std::vector<Column>& more) {
  report::Table table{{"", "options", "relMSE", "MSE", "SSIM", "FLIP", "energy", "CPU s"}, {}, 2};
  for (const Column& column : more) table.header.push_back(column.name);
  for (const Outcome* o : outcomes) {
    std::vector<std::string> row = {o->run.label, treatment_of(o->run)};
    for (const char* error : {"relMSE", "MSE", "SSIM", "FLIP"}) row.push_back(number(o->error(error)));
    row.push_back(fmt::format("{:.3f}", o->line.at("energy").get<double>()));
    row.push_back(fmt::format("{:.2f}", o->cpu()));
    for (const Column& column : more) row.push_back(column.text(*o));
    table.rows.push_back(row);
  }
  page_.table(table);
}

std::string Story::picture_of(const Image& image, const std::string& name, const std::optional<Region>& region) {
  const std::string file = (fs::path(pictures_) / (name + ".png")).string();
  std::optional<Window> crop;
  if (region) crop = window_of(*region, image.data_window);
  write_image(file, report::side_by_side({image}, crop));
  return file;
}

void Story::pictures(const Outcomes& outcomes, const std::optional<Region>& region) {
  std::vector<report::Picture> all;
  for (const Outcome* o : outcomes) {
    const std::string name =
        fmt::format("{}-{}spp-{}", o->run.frame.scene, o->run.frame.samples_per_pixel, o->run.label);
    all.push_back({picture_of(read_image(o->image), name, region),
                   fmt::format("{}: relMSE {}", o->run.label, number(o->error("relMSE")))});
  }
  const bench::SweepFrame& frame = outcomes.front()->run.frame;
  all.push_back({picture_of(read_image(frame.reference), frame.scene + "-reference", region),
                 fmt::format("reference, {} samples a pixel", frame.reference_samples)});
  page_.pictures(all);
}

void Story::plot(const std::string& name, const report::Plot& plot, const std::string& caption) {
  const std::string svg = report::svg_of(plot);
  report::write_text((fs::path(pictures_) / (name + ".svg")).string(), svg);
  page_.plot(svg, caption);
}

void Story::value(const std::string& group, const std::string& name, double number) {
  json_["values"][group][name] = number;
}

double Story::number_in(const Outcome& outcome, const Region& region,
                        double (*measure)(const Image&, const Image&, const Region&)) {
  return measure(read_image(outcome.image), read_image(outcome.run.frame.reference), region);
}

Column Story::measure_in(const Region& region, const char* name,
                         double (*measure)(const Image&, const Image&, const Region&)) {
  const std::string title = fmt::format("{}, {}", region.name, name);
  return {title, [=](const Outcome& o) {
            const double n = number_in(o, region, measure);
            value(fmt::format("{} {}", o.run.frame.scene, title), o.run.label, n);
            return number(n);
          }};
}

Column Story::error_in(const Region& region) { return measure_in(region, "relMSE", region_error); }
Column Story::detail_in(const Region& region) { return measure_in(region, "detail kept", kept_detail); }
Column Story::step_in(const Region& region) { return measure_in(region, "step kept", kept_step); }

void Story::write(const std::string& stem) {
  std::set<std::string> scenes;
  for (const Outcome& o : findings_.all())
    for (std::size_t i : {0, 1}) scenes.insert(o.line.at("commands").at(i).get<std::string>());
  std::string text;
  for (const std::string& command : scenes) text += command + "\n";
  const bench::SweepFrame& frame = findings_.all().front().run.frame;
  text += fmt::format("rpf OPTIONS {} -o filtered.exr\nrpf compare filtered.exr {}\n",
                      fs::path(frame.samples).filename().string(), fs::path(frame.reference).filename().string());
  page_.heading("To repeat a run");
  page_.paragraph("Scenes and references; then OPTIONS of the table's row, on its scene. The backend does not matter.");
  page_.code(text);
  for (const Outcome& o : findings_.all()) json_["runs"].push_back(o.line);
  report::write_text(stem + ".json", json_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  page_.write(stem + ".html");
}

}  // namespace rpf::study
