// What several experiments do: every setting on every scene, and one setting against another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/story.h"

namespace rpf::study {

/// A setting of an experiment.
struct Setting {
  const char* label;
  const char* options;
};

/// Every setting on every scene.
std::vector<Run> runs_of(const std::vector<const char*>& scenes, const std::vector<Setting>& settings,
                         const Extent& extent);

/// A number of a run.
struct Quantity {
  std::string name;
  std::function<double(const Outcome&)> of;
};

/// An error that docs/commands.md lists under "compare".
Quantity error_named(const char* name);
Quantity cpu_seconds();

/// Whether `a` has less of a quantity than `b` (labels of runs), scene by scene.
Verdict less(const Findings& findings, const std::string& statement, const std::string& a, const std::string& b,
             const Quantity& quantity);

/// relMSE as part of the plain mean's: a curve a label, a point a scene.
report::Plot plot_by_scene(const Findings& findings, const std::vector<std::string>& labels);

/// relMSE as part of the plain mean's on the same samples.
double part_of_mean(const Findings& findings, const Outcome& outcome);

}  // namespace rpf::study
