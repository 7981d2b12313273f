#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// The options of `rpf INPUT -o OUTPUT` as they were written.
struct FilterOptions {
  std::string input, output, aov, report;
  std::string method = "rpf", profile = "thesis", boxes, features, random, crop;
  double samples_factor = 0;  ///< 0: not given
  float sigma_color = 0;      ///< 0: not given
  std::vector<std::string> map;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  std::string progress = "auto";
  std::string preset, time_budget;
  std::string facts, rows;  ///< of a frame that is filtered in parts
  bool verbose = false, quiet = false, dry_run = false;
  Settings settings;  ///< the options that need no translation

  /// The command takes the fast way where there is one: the bits are the same.
  FilterOptions() { settings.backend = "auto"; }
};

/// An option that names a file of one frame; in a sequence its name has a place for the frame's number.
struct FrameFile {
  const char* option;
  std::string FilterOptions::*path;
  bool is_result;
};
constexpr FrameFile frame_files[] = {{"-o", &FilterOptions::output, true},
                                     {"--aov", &FilterOptions::aov, true},
                                     {"--report", &FilterOptions::report, true},
                                     {"--facts", &FilterOptions::facts, false}};

/// Which features and random parameters to model.
void add_channel_options(CLI::App& app, FilterOptions& options);
/// "--preset", one of those that there are.
void add_preset_option(CLI::App& app, std::string& preset);
/// "--backend" and "--device".
std::array<CLI::Option*, 2> add_backend_options(CLI::App& app, std::string& backend, std::string& device);
/// Threads, memory, what is told.
void add_running_options(CLI::App& app, FilterOptions& options);
/// The same with the backend.
void add_machine_options(CLI::App& app, FilterOptions& options);
/// "--max-memory", shared by the commands that read; memory_limit() takes what it says.
CLI::Option* add_memory_option(CLI::App& app, std::uint64_t& megabytes);
void add_filter_options(CLI::App& app, FilterOptions& options);

/// Makes these settings what the options are where they are not given, but for the backend, which is the command's.
void start_from(const Settings& named, FilterOptions& options);

/// Makes the settings that --method or --preset among the arguments name what the options are where they are not given:
/// to be called before the parser runs. Without either, and without an option that only the published algorithms have,
/// they are those of the preset that is called balanced. `preset` in place of the arguments' where it is not empty.
/// Throws Error(usage) for an unknown name.
void start_from_named_settings(const std::vector<std::string>& arguments, const std::string& preset,
                               FilterOptions& options);

/// Parses the options of a filter run alone, with a preset to start from; empty: none but what --preset says. Throws
/// CLI::ParseError, and Error(usage) for an unknown preset.
FilterOptions parse_filter_options(const std::vector<std::string>& arguments, const std::string& preset = {});

/// The options that say what is made of the samples: those that facts of a frame depend on.
void add_picture_options(CLI::App& app, FilterOptions& options);

/// Translates the options. Throw Error(usage) that names the option.
Settings settings_of(const FilterOptions& options);
double time_budget_of(const FilterOptions& options);  ///< seconds; 0 where none is given
SampleReadOptions read_options_of(const std::vector<std::string>& map, std::uint64_t max_memory);
/// With the memory and threads of the settings.
SampleReadOptions read_options_of(const FilterOptions& options, const Settings& settings);

/// WxH+X+Y as oiiotool writes it; X and Y may be negative (100x50-7+3).
Window window_of(const std::string& option, const std::string& text);

/// Width and height of "--size WxH".
std::pair<int, int> size_of(const std::string& text);

/// "--map SLOT=CHANNEL", shared by the commands that read sample files.
void add_map_option(CLI::App& app, std::vector<std::string>& map);

}  // namespace rpf::cli
