// "Model only what a scene requires": leaves out channels that are not constant and yet say nothing.
#pragma once

#include <string>
#include <vector>

#include "frame/prepare.h"

namespace rpf {

/// Leaves out of a prepared frame the random parameters that tell nothing about colors or features, and the features
/// that tell nothing about colors (information.h): frame and facts become those of samples without these channels, in
/// place. Their names are added to `uninformative`. A frame on which too little can be measured keeps all.
void drop_uninformative(PreparedFrame& prepared, const Settings& settings);

/// Leaves these out in the same way.
void drop_channels(PreparedFrame& prepared, const std::vector<std::string>& names);

}  // namespace rpf
