// The distribution effects: 4 samples a pixel, filtered, reference.
#include <fmt/format.h>

#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

const std::vector<const char*> scenes = {"dof", "motion", "soft-shadow", "glossy", "combined"};

const std::vector<Setting> settings = {{"plain mean", plain_mean},        {"thesis", "--profile thesis"},
                                       {"paper", "--profile paper"},      {"fast", "--preset fast"},
                                       {"balanced", "--preset balanced"}, {"high", "--preset high"}};

/// The plain mean's error falls with the number of samples: so many it would take for the error of the filtered image.
double worth(const Findings& findings, const Outcome& outcome) {
  return outcome.run.frame.samples_per_pixel / part_of_mean(findings, outcome);
}

}  // namespace

std::vector<Run> plan_effects(const Extent& extent) { return runs_of(scenes, settings, extent); }

void tell_effects(const Findings& findings, Story& story) {
  const auto removes_noise = [&](const char* statement, const char* label) {
    return less(findings, statement, label, "plain mean", error_named("relMSE"));
  };
  story.verdicts({removes_noise("The thesis's filter removes the noise of every effect", "thesis"),
                  removes_noise("So does the paper's", "paper"),
                  removes_noise("So does the preset balanced", "balanced")});
  story.plot("effects", plot_by_scene(findings, {"thesis", "paper", "fast", "balanced", "high"}),
             "Error of each method as part of the plain mean's, scene by scene");
  for (const char* scene : scenes) {
    story.heading(scene);
    story.pictures({&findings.at(scene, "plain mean"), &findings.at(scene, "thesis"), &findings.at(scene, "balanced")},
                   center);
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
