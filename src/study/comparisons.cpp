#include "study/comparisons.h"

#include <fmt/format.h>

namespace rpf::study {

std::vector<Run> runs_of(const std::vector<const char*>& scenes, const std::vector<Setting>& settings,
                         const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes)
    for (const Setting& setting : settings) runs.push_back({setting.label, frame_of(scene, extent), setting.options});
  return runs;
}

Quantity error_named(const char* name) {
  return {name, [name](const Outcome& o) { return o.error(name); }};
}

Quantity cpu_seconds() {
  return {"CPU seconds", [](const Outcome& o) { return o.cpu(); }};
}

Verdict less(const Findings& findings, const std::string& statement, const std::string& a, const std::string& b,
             const Quantity& quantity) {
  const std::vector<std::string> scenes = findings.scenes();
  std::size_t holding = 0;
  std::string measured = fmt::format("{} of {} and {}:", quantity.name, a, b);
  for (const std::string& scene : scenes) {
    const double x = quantity.of(findings.at(scene, a)), y = quantity.of(findings.at(scene, b));
    holding += x < y ? 1 : 0;
    measured += fmt::format(" {} {}, {};", scene, number(x), number(y));
  }
  measured.pop_back();
  return {statement, measured, verdict_of(holding, scenes.size())};
}

report::Plot plot_by_scene(const Findings& findings, const std::vector<std::string>& labels) {
  const std::vector<std::string> scenes = findings.scenes();
  report::Plot plot{"", "relMSE, part of the plain mean's", {}, false, true, false, {}};
  for (const std::string& scene : scenes) {
    plot.x_ticks.push_back(static_cast<double>(plot.x_ticks.size() + 1));
    plot.x_label += fmt::format("{}{} {}", plot.x_label.empty() ? "" : ", ", plot.x_ticks.size(), scene);
  }
  for (const std::string& label : labels) {
    report::Curve curve{label, {}};
    for (std::size_t i = 0; i < scenes.size(); ++i)
      curve.points.push_back({plot.x_ticks[i], part_of_mean(findings, findings.at(scenes[i], label))});
    plot.curves.push_back(curve);
  }
  return plot;
}

double part_of_mean(const Findings& findings, const Outcome& outcome) {
  const bench::SweepFrame& frame = outcome.run.frame;
  return outcome.error("relMSE") / findings.at(frame.scene, "plain mean", frame.samples_per_pixel).error("relMSE");
}

}  // namespace rpf::study
