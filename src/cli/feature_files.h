// --aov: the filtered features as one file, or as one a group in a folder.
#pragma once

#include <string>
#include <vector>

#include "rpf/image.h"
#include "rpf/outputs.h"

namespace rpf::cli {

/// What would be written to `aov` of features with these channels. Throws Error(input) for a group that is no file
/// name.
std::vector<PlannedOutput> planned_features(const std::string& aov, const std::vector<std::string>& channels,
                                            const Window& window);

void write_features(const std::string& aov, const Image& features);

}  // namespace rpf::cli
