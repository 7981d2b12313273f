// Suggestions for a name that was not found: "did you mean".
#pragma once

#include <string>
#include <vector>

namespace rpf::io {

/// The up to three candidates nearest to `name` by edit distance, quoted and joined with commas.
std::string near_names(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace rpf::io
