// Options that are one of a few names.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rpf::cli {

/// Takes these names only. A refusal names `variable` of the environment where the text comes from there.
CLI::Validator one_of(const std::vector<std::string>& names, const std::string& variable = {});

}  // namespace rpf::cli
