// What the runs of a study brought.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/experiment.h"

namespace rpf::study {

/// A run and what it brought. The files are images of linear light.
struct Outcome {
  Run run;
  nlohmann::ordered_json line;  ///< of the results file
  std::string image;            ///< file of the filtered image; the reference is run.frame.reference

  /// One of the errors that docs/commands.md lists under "compare"; NaN where it is not defined.
  double error(const char* name) const;
  double cpu() const { return line.at("cpu").get<double>(); }  ///< seconds
};

class Findings {
 public:
  explicit Findings(std::vector<Outcome> outcomes) : outcomes_(std::move(outcomes)) {}

  const std::vector<Outcome>& all() const { return outcomes_; }
  /// The scenes in the order of the plan.
  std::vector<std::string> scenes() const;
  /// Whether the plan has runs of this label.
  bool has(const std::string& label) const;
  /// Those on one scene, in the order of the plan.
  std::vector<const Outcome*> on(const std::string& scene) const;
  /// Throws Error(internal) for a run that the plan does not have.
  const Outcome& at(const std::string& scene, const std::string& label, int samples_per_pixel = 4) const;

 private:
  std::vector<Outcome> outcomes_;
};

}  // namespace rpf::study
