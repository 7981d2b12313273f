// Which filter: --method and what only some methods know.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/filter_options.h"

namespace rpf::cli {

/// --sigma-color of an image where it is not given: most images end at 1, and have less noise than samples.
constexpr float image_sigma_color = 0.1F;

/// --method and the sigmas. After parsing, options that mean nothing to the method are refused: Error(usage).
void add_method_options(CLI::App& app, FilterOptions& options);

/// Whether a method needs no more of a sample than an image has.
bool filters_images(Method method);

}  // namespace rpf::cli
