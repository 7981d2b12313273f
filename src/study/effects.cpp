// The distribution effects: 4 samples a pixel, filtered, reference.
#include <fmt/format.h>

#include "study/story.h"

namespace rpf::study {
namespace {

constexpr const char* scenes[] = {"dof", "motion", "soft-shadow", "glossy", "combined"};

/// The plain mean's error falls with the number of samples: so many it would take for the error of the filtered image.
double worth(const Findings& findings, const Outcome& outcome) {
  const double mean = findings.at(outcome.run.frame.scene, "plain mean").error("relMSE");
  return outcome.run.frame.samples_per_pixel * mean / outcome.error("relMSE");
}

Verdict verdict_on(const Findings& findings, const char* label, const char* statement) {
  std::size_t holding = 0, all = 0;
  std::string measured = "relMSE of 4 samples and filtered:";
  for (const std::string& scene : findings.scenes()) {
    const double before = findings.at(scene, "plain mean").error("relMSE"),
                 after = findings.at(scene, label).error("relMSE");
    holding += after < before ? 1 : 0;
    ++all;
    measured += fmt::format(" {} {} to {};", scene, number(before), number(after));
  }
  measured.pop_back();
  return {statement, measured, verdict_of(holding, all)};
}

report::Plot worth_plot(const Findings& findings) {
  report::Plot plot{"", "relMSE, part of the plain mean's", {}, false, true, false, {}};
  plot.x_label = "1 dof, 2 motion, 3 soft-shadow, 4 glossy, 5 combined";
  plot.x_ticks = {1, 2, 3, 4, 5};
  for (const char* label : {"thesis", "paper", "fast", "balanced", "high"}) {
    report::Curve curve{label, {}};
    for (std::size_t i = 0; i < std::size(scenes); ++i)
      curve.points.push_back({double(i + 1), findings.at(scenes[i], label).error("relMSE") /
                                                 findings.at(scenes[i], "plain mean").error("relMSE")});
    plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace

std::vector<Run> plan_effects(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes) {
    const bench::SweepFrame frame = frame_of(scene, extent);
    runs.push_back({"plain mean", frame, plain_mean});
    runs.push_back({"thesis", frame, "--profile thesis"});
    runs.push_back({"paper", frame, "--profile paper"});
    for (const char* preset : {"fast", "balanced", "high"})
      runs.push_back({preset, frame, fmt::format("--preset {}", preset)});
  }
  return runs;
}

void tell_effects(const Findings& findings, Story& story) {
  story.verdicts({verdict_on(findings, "thesis", "The thesis's filter removes the noise of every effect"),
                  verdict_on(findings, "paper", "So does the paper's"),
                  verdict_on(findings, "balanced", "So does the preset balanced")});
  story.plot("effects", worth_plot(findings), "Error of each method as part of the plain mean's, scene by scene");
  for (const char* scene : scenes) {
    story.heading(scene);
    story.pictures({&findings.at(scene, "plain mean"), &findings.at(scene, "thesis"), &findings.at(scene, "balanced")},
                   Region{"", -0.125, -0.07, 0.25, 0.14});
    story.runs(findings.on(scene), {{"worth, samples", [&](const Outcome& o) {
                                       story.value(std::string(scene) + " worth", o.run.label, worth(findings, o));
                                       return fmt::format("{:.0f}", worth(findings, o));
                                     }}});
  }
  story.paragraph(
      "Worth: so many samples a pixel the plain mean would need for the same relMSE, since its error falls as one over "
      "their number.");
}

}  // namespace rpf::study
