// The pages of an explanation, and the pictures they show.
#pragma once

#include <string>

#include "report/html_page.h"
#include "rpf/explain.h"

namespace rpf::cli {

/// Writes explain.exr, density.exr, a PNG of every map and index.html into an existing folder. `input`: the file that
/// is explained. Each file is whole or untouched; index.html comes last.
void write_explanation(const std::string& folder, const std::string& input, const Explanation& explanation);

/// "pixel-X-Y": its page without extension, and the folder of the page's pictures.
std::string pixel_page_name(const PixelPosition& pixel);

/// Writes pixel-X-Y.html about Explanation::pixel and what a preset makes of it, and the pictures into a folder
/// pixel-X-Y. Returns the page's path.
std::string write_pixel_page(const std::string& folder, const std::string& input, const Explanation& explanation,
                             const ExplainedEstimate& estimate);

/// The chapter of that page about the preset's picture: its pictures go into `folder`. `frame`: the plain mean.
void add_estimate(const std::string& folder, const Image& frame, const ExplainedEstimate& estimate,
                  report::HtmlPage& page);

}  // namespace rpf::cli
