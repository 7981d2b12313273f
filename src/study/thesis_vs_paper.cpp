// The thesis's profile against the paper's.
#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

// The two differ in M, in the outlier step, and in the position inside the pixel: one change at a time.
const std::vector<Setting> settings = {{"plain mean", plain_mean},
                                       {"thesis", "--profile thesis"},
                                       {"paper", "--profile paper"},
                                       {"thesis, M of the paper", "--profile thesis --samples-factor 2"},
                                       {"paper, M of the thesis", "--profile paper --samples-factor 0.5"},
                                       {"paper, with pixel", "--profile paper --random lens,time,light,pixel"}};

std::vector<const char*> scenes(bool quick) {
  return quick ? std::vector<const char*>{"dof", "glossy", "dof-hdr"}
               : std::vector<const char*>{"dof", "motion", "soft-shadow", "glossy", "menger", "dof-hdr"};
}

}  // namespace

std::vector<Run> plan_thesis_vs_paper(const Extent& extent) { return runs_of(scenes(extent.quick), settings, extent); }

void tell_thesis_vs_paper(const Findings& findings, Story& story) {
  const Quantity relmse = error_named("relMSE"), seconds = {"CPU seconds", &Outcome::cpu};
  story.verdicts(
      {less(findings, "The thesis's profile is faster", "thesis", "paper", seconds),
       less(findings, "It has the smaller error", "thesis", "paper", relmse),
       less(findings, "The same at every exposure", "thesis", "paper", error_named("HDR_FLIP")),
       less(findings, "More samples (M of the paper) lower the thesis's error", "thesis, M of the paper", "thesis",
            relmse),
       less(findings, "The outlier step lowers the error", "paper, with pixel", "thesis, M of the paper", relmse)});
  story.plot("errors",
             plot_by_scene(findings, {"thesis", "paper", "thesis, M of the paper", "paper, M of the thesis",
                                      "paper, with pixel"}),
             "Error as part of the plain mean's, scene by scene");
  const Column hdr{"HDR FLIP", [](const Outcome& o) { return number(o.error("HDR_FLIP")); }};
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    const bool cornell = scene == "glossy" || scene == "menger";
    story.pictures({&findings.at(scene, "plain mean"), &findings.at(scene, "thesis"), &findings.at(scene, "paper")},
                   cornell ? ceiling : center);
    std::vector<Column> more = {hdr};
    if (cornell) more.push_back(story.error_in(lamp));
    story.runs(findings.on(scene), more);
  }
}

}  // namespace rpf::study
