// The thesis's profile against the paper's.
#include <fmt/format.h>

#include "study/story.h"

namespace rpf::study {
namespace {

struct Choice {
  const char* label;
  const char* options;
};

// The two differ in M, in the outlier step, and in the position inside the pixel: one change at a time.
constexpr Choice choices[] = {{"plain mean", plain_mean},
                              {"thesis", "--profile thesis"},
                              {"paper", "--profile paper"},
                              {"thesis, M of the paper", "--profile thesis --samples-factor 2"},
                              {"paper, M of the thesis", "--profile paper --samples-factor 0.5"},
                              {"paper, with pixel", "--profile paper --random lens,time,light,pixel"}};

constexpr Region lamp = {"lamp", -0.125, -0.281, 0.25, 0.078};

std::vector<const char*> scenes(bool quick) {
  return quick ? std::vector<const char*>{"dof", "glossy", "dof-hdr"}
               : std::vector<const char*>{"dof", "motion", "soft-shadow", "glossy", "menger", "dof-hdr"};
}

/// Whether the first has less of a number than the second, scene by scene.
Verdict less(const Findings& findings, const char* statement, const char* name, const char* a, const char* b,
             const std::function<double(const Outcome&)>& of) {
  std::size_t holding = 0;
  std::string measured = fmt::format("{} of {} and {}:", name, a, b);
  for (const std::string& scene : findings.scenes()) {
    const double x = of(findings.at(scene, a)), y = of(findings.at(scene, b));
    holding += x < y ? 1 : 0;
    measured += fmt::format(" {} {}, {};", scene, number(x), number(y));
  }
  measured.pop_back();
  return {statement, measured, verdict_of(holding, findings.scenes().size())};
}

std::function<double(const Outcome&)> error_named(const char* name) {
  return [name](const Outcome& o) { return o.error(name); };
}

report::Plot error_plot(const Findings& findings) {
  report::Plot plot{"CPU seconds", "relMSE, part of the plain mean's", {}, true, true, false, {}};
  for (const Choice& choice : choices) {
    if (choice.options == plain_mean) continue;
    report::Curve curve{choice.label, {}};
    for (const std::string& scene : findings.scenes()) {
      const Outcome& o = findings.at(scene, choice.label);
      curve.points.push_back({o.cpu(), o.error("relMSE") / findings.at(scene, "plain mean").error("relMSE")});
    }
    plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace

std::vector<Run> plan_thesis_vs_paper(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes(extent.quick))
    for (const Choice& choice : choices) runs.push_back({choice.label, frame_of(scene, extent), choice.options});
  return runs;
}

void tell_thesis_vs_paper(const Findings& findings, Story& story) {
  story.verdicts({less(findings, "The thesis's profile is faster", "CPU seconds", "thesis", "paper",
                       [](const Outcome& o) { return o.cpu(); }),
                  less(findings, "It has the smaller error", "relMSE", "thesis", "paper", error_named("relMSE")),
                  less(findings, "The same at every exposure", "HDR_FLIP", "thesis", "paper", error_named("HDR_FLIP")),
                  less(findings, "More samples (M of the paper) lower the thesis's error", "relMSE",
                       "thesis, M of the paper", "thesis", error_named("relMSE")),
                  less(findings, "The outlier step lowers the error", "relMSE", "paper, with pixel",
                       "thesis, M of the paper", error_named("relMSE"))});
  story.plot("error-and-time", error_plot(findings), "A point a scene");
  const Column hdr{"HDR FLIP", [](const Outcome& o) { return number(o.error("HDR_FLIP")); }};
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    const bool cornell = scene == "glossy" || scene == "menger";
    story.pictures({&findings.at(scene, "plain mean"), &findings.at(scene, "thesis"), &findings.at(scene, "paper")},
                   cornell ? Region{"", -0.2, -0.281, 0.4, 0.22} : Region{"", -0.125, -0.07, 0.25, 0.14});
    std::vector<Column> more = {hdr};
    if (cornell) more.push_back(story.error_in(lamp));
    story.runs(findings.on(scene), more);
  }
}

}  // namespace rpf::study
