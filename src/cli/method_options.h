// Which filter: --method and what only some methods know.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/filter_options.h"

namespace rpf::cli {

/// --sigma-color of an image where it is not given: most images end at 1, and have less noise than samples.
constexpr float image_sigma_color = 0.1F;

/// Whether one of the arguments is an option that means something to Random Parameter Filtering, or to methods with
/// fixed weights, and nothing to the learned estimator.
bool asks_for_published(const std::vector<std::string>& arguments);

/// --method and the sigmas. After parsing, options that mean nothing to the method are refused: Error(usage).
void add_method_options(CLI::App& app, FilterOptions& options);

/// Whether a method needs no more of a sample than an image has.
bool filters_images(Method method);

}  // namespace rpf::cli
