// The filters there are: Random Parameter Filtering and the baselines that the thesis compares it with.
#pragma once

#include <string>
#include <vector>

#include "rpf/settings.h"

namespace rpf {

/// The names of the methods, in the order of Method: "rpf", "gaussian", "bilateral", "cross-bilateral", "learned".
std::vector<std::string> method_names();
std::string name_of(Method method);

/// The settings of a method: box widths, sigmas and features that did well for it (docs/methods.md); whatever it does
/// not choose has its default. Throws Error(usage) for an unknown name, naming those there are.
Settings method_settings(const std::string& name);

}  // namespace rpf
