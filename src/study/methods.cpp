// The classic filters against Random Parameter Filtering.
#include <fmt/format.h>

#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

const std::vector<Setting> settings = {{"plain mean", plain_mean},
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

Verdict beats(const Findings& findings, const std::string& better, const std::string& worse) {
  return less(findings, fmt::format("{} is better than {}", better, worse), better, worse, error_named("relMSE"));
}

}  // namespace

std::vector<Run> plan_methods(const Extent& extent) { return runs_of(scenes(extent.quick), settings, extent); }

void tell_methods(const Findings& findings, Story& story) {
  story.verdicts({beats(findings, "thesis", "Gaussian"), beats(findings, "thesis", "bilateral"),
                  beats(findings, "thesis", "cross-bilateral"), beats(findings, "paper", "cross-bilateral"),
                  beats(findings, "balanced", "cross-bilateral"), beats(findings, "cross-bilateral", "Gaussian")});
  story.paragraph(
      "Cross-bilateral: the features with fixed weights, which is what Random Parameter Filtering would be without its "
      "statistics. All work on samples.");
  story.plot("methods",
             plot_by_scene(findings, {"Gaussian", "bilateral", "bilateral, narrow", "cross-bilateral", "thesis",
                                      "paper", "balanced"}),
             "Error of each method as part of the plain mean's, scene by scene");
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    story.pictures(
        {&findings.at(scene, "plain mean"), &findings.at(scene, "Gaussian"), &findings.at(scene, "cross-bilateral"),
         &findings.at(scene, "thesis"), &findings.at(scene, "balanced")},
        center);
    story.runs(findings.on(scene));
  }
}

}  // namespace rpf::study
