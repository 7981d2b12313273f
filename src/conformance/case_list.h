// How the list of cases is made; cases.cpp and method_cases.cpp fill it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "conformance/cases.h"

namespace rpf {

/// Builds the list: every case once for each profile.
class CaseList {
 public:
  std::vector<ConformanceCase> cases;

  /// The case of most groups: a frame that is quick, and large enough for a box of 21 to be cut on all sides.
  static ConformanceCase basic(const std::string& scene = "dof", int samples = 4) {
    ConformanceCase c;
    c.scene = scene;
    c.options.width = 25;
    c.options.height = 18;
    c.options.samples = samples == varying ? 3 : samples;
    c.options.adaptive = samples == varying;
    c.settings.box_widths = {15, 7};
    return c;
  }

  void add(const std::string& name, ConformanceCase c) {
    for (const Profile profile : {Profile::thesis, Profile::paper}) {
      c.name = fmt::format("{}/{}", name, profile == Profile::thesis ? "thesis" : "paper");
      c.settings.profile = profile;
      cases.push_back(c);
    }
  }
  void add(const std::string& name, const std::function<void(Settings&)>& set) {
    ConformanceCase c = basic();
    set(c.settings);
    add(name, c);
  }

  static constexpr int varying = 0;
};

/// "varying", or "4spp".
std::string count_name(int samples);

using Change = std::function<void(SampleBuffer&)>;

/// Sets one channel of every `step`-th sample.
Change poison(const std::string& slot, float value, std::size_t step);

/// What may stand in a sample, each with its name.
std::vector<std::pair<std::string, Change>> extremes();

/// The methods with fixed weights.
void add_methods(CaseList& list);

/// The learned estimator.
void add_estimator(CaseList& list);

}  // namespace rpf
