// The filters there are: Random Parameter Filtering and the baselines that the thesis compares it with.
#pragma once

#include <string>
#include <vector>

#include "rpf/settings.h"

namespace rpf {

/// The names of the methods, in the order of Method: "rpf", "gaussian", "bilateral", "cross-bilateral", "learned",
/// "nlm", "gem", "sbf", "axis-aligned", "lightfield", "multidim".
std::vector<std::string> method_names();
std::string name_of(Method method);

/// Whether a method filters pixels (algorithm.md, section 9): it looks at means and variances, not at single samples,
/// and needs two samples in a pixel (all but axis-aligned).
bool filters_pixels(Method method);

/// Whether a method can be had of the whole frame only, not of rows of it: those that filter pixels, lightfield
/// and multidim.
bool needs_whole_frame(Method method);

/// Whether a method has to know how far each feature spreads over the frame.
bool needs_feature_spread(Method method);

/// Whether a method also looks at channels that have one value in the whole frame; all others drop them.
bool keeps_constant_channels(Method method);

/// The settings of a method: box widths, sigmas and features that did well for it (docs/methods.md); whatever it does
/// not choose has its default. Throws Error(usage) for an unknown name, naming those there are.
Settings method_settings(const std::string& name);

}  // namespace rpf
