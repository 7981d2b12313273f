// The pages of an explanation, and the pictures they show.
#pragma once

#include <string>

#include "rpf/explain.h"

namespace rpf::cli {

/// Writes explain.exr, density.exr, a PNG of every map and index.html into an existing folder. `input`: the file that
/// is explained. Each file is whole or untouched; index.html comes last.
void write_explanation(const std::string& folder, const std::string& input, const Explanation& explanation);

/// Writes pixel-X-Y.html about Explanation::pixel, and its pictures into a folder pixel-X-Y. Returns the page's path.
std::string write_pixel_page(const std::string& folder, const std::string& input, const Explanation& explanation);

}  // namespace rpf::cli
