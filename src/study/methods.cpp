// The classic filters against Random Parameter Filtering.
#include <fmt/format.h>

#include "study/story.h"

namespace rpf::study {
namespace {

struct Choice {
  const char* label;
  const char* options;
};

constexpr Choice choices[] = {{"plain mean", plain_mean},
                              {"Gaussian", "--method gaussian"},
                              {"bilateral", "--method bilateral"},
                              {"bilateral, narrow", "--method bilateral --sigma-color 1"},
                              {"cross-bilateral", "--method cross-bilateral"},
                              {"thesis", "--profile thesis"},
                              {"paper", "--profile paper"},
                              {"balanced", "--preset balanced"}};

std::vector<const char*> scenes(bool quick) {
  return quick ? std::vector<const char*>{"dof", "soft-shadow", "glossy"}
               : std::vector<const char*>{"dof", "motion", "soft-shadow", "glossy", "column", "combined"};
}

/// Whether `better` has the smaller relMSE, scene by scene.
Verdict beats(const Findings& findings, const char* better, const char* worse) {
  std::size_t holding = 0;
  std::string measured = fmt::format("relMSE of {} and {}:", better, worse);
  for (const std::string& scene : findings.scenes()) {
    const double a = findings.at(scene, better).error("relMSE"), b = findings.at(scene, worse).error("relMSE");
    holding += a < b ? 1 : 0;
    measured += fmt::format(" {} {}, {};", scene, number(a), number(b));
  }
  measured.pop_back();
  return {fmt::format("{} is better than {}", better, worse), measured, verdict_of(holding, findings.scenes().size())};
}

report::Plot error_plot(const Findings& findings) {
  report::Plot plot{"", "relMSE, part of the plain mean's", {}, false, true, false, {}};
  const std::vector<std::string> scenes = findings.scenes();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    plot.x_label += fmt::format("{}{} {}", i > 0 ? ", " : "", i + 1, scenes[i]);
    plot.x_ticks.push_back(static_cast<double>(i + 1));
  }
  for (const Choice& choice : choices) {
    if (choice.options == plain_mean) continue;
    report::Curve curve{choice.label, {}};
    for (std::size_t i = 0; i < scenes.size(); ++i)
      curve.points.push_back({static_cast<double>(i + 1), findings.at(scenes[i], choice.label).error("relMSE") /
                                                              findings.at(scenes[i], "plain mean").error("relMSE")});
    plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace

std::vector<Run> plan_methods(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes(extent.quick))
    for (const Choice& choice : choices) runs.push_back({choice.label, frame_of(scene, extent), choice.options});
  return runs;
}

void tell_methods(const Findings& findings, Story& story) {
  story.verdicts({beats(findings, "thesis", "Gaussian"), beats(findings, "thesis", "bilateral"),
                  beats(findings, "thesis", "cross-bilateral"), beats(findings, "paper", "cross-bilateral"),
                  beats(findings, "balanced", "cross-bilateral"), beats(findings, "cross-bilateral", "Gaussian")});
  story.paragraph(
      "Cross-bilateral: the features with fixed weights, which is what Random Parameter Filtering would be without its "
      "statistics. All work on samples.");
  story.plot("methods", error_plot(findings), "Error of each method as part of the plain mean's, scene by scene");
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    story.pictures(
        {&findings.at(scene, "plain mean"), &findings.at(scene, "Gaussian"), &findings.at(scene, "cross-bilateral"),
         &findings.at(scene, "thesis"), &findings.at(scene, "balanced")},
        Region{"", -0.125, -0.07, 0.25, 0.14});
    story.runs(findings.on(scene));
  }
}

}  // namespace rpf::study
