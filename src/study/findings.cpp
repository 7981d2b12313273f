#include "study/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rpf/error.h"

namespace rpf::study {

double Outcome::error(const char* name) const {
  const nlohmann::ordered_json& number = line.at("error").at(name);
  return number.is_number() ? number.get<double>() : std::nan("");  // JSON has no NaN
}

std::vector<std::string> Findings::scenes() const {
  std::vector<std::string> names;
  for (const Outcome& outcome : outcomes_)
    if (std::find(names.begin(), names.end(), outcome.run.frame.scene) == names.end())
      names.push_back(outcome.run.frame.scene);
  return names;
}

std::vector<const Outcome*> Findings::on(const std::string& scene) const {
  std::vector<const Outcome*> some;
  for (const Outcome& outcome : outcomes_)
    if (outcome.run.frame.scene == scene) some.push_back(&outcome);
  return some;
}

bool Findings::has(const std::string& label) const {
  return std::any_of(outcomes_.begin(), outcomes_.end(), [&](const Outcome& o) { return o.run.label == label; });
}

const Outcome& Findings::at(const std::string& scene, const std::string& label, int samples_per_pixel) const {
  for (const Outcome& outcome : outcomes_)
    if (outcome.run.frame.scene == scene && outcome.run.label == label &&
        outcome.run.frame.samples_per_pixel == samples_per_pixel)
      return outcome;
  throw Error(ErrorKind::internal, fmt::format("study: no run \"{}\" on {} with {} samples a pixel; report this defect",
                                               label, scene, samples_per_pixel));
}

}  // namespace rpf::study
