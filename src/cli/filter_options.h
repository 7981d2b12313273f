#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// The options of `rpf INPUT -o OUTPUT` as they were written.
struct FilterOptions {
  std::string input, output, aov;
  std::string profile = "thesis", boxes, features, random, crop;
  double samples_factor = 0, neighbors_factor = 0;  ///< 0: not given
  std::vector<std::string> map;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  std::string progress = "auto";
  bool verbose = false, quiet = false, dry_run = false;
  Settings settings;  ///< the options that need no translation
};

void add_filter_options(CLI::App& app, FilterOptions& options);

/// Translates the options. Throw Error(usage) that names the option.
Settings settings_of(const FilterOptions& options);
SampleReadOptions read_options_of(const std::vector<std::string>& map, std::uint64_t max_memory);

/// WxH+X+Y as oiiotool writes it; X and Y may be negative (100x50-7+3).
Window window_of(const std::string& option, const std::string& text);

/// "--map SLOT=CHANNEL", shared by the commands that read sample files.
void add_map_option(CLI::App& app, std::vector<std::string>& map);

}  // namespace rpf::cli
