// The subcommands. Each adds its options to the parser and returns what to run when it was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace rpf::cli {

/// Runs a command; returns the exit code.
using Command = std::function<int()>;

/// rpf INPUT -o OUTPUT. `arguments`: those of the command line, for what depends on them before and after parsing.
Command add_filter_command(CLI::App& app, const std::vector<std::string>& arguments);
Command add_info_command(CLI::App& app);  ///< rpf info FILE
/// rpf facts FILE -o FACTS. `arguments`: as above.
Command add_facts_command(CLI::App& app, const std::vector<std::string>& arguments);
Command add_join_command(CLI::App& app);      ///< rpf join PART... -o FILE
Command add_compare_command(CLI::App& app);   ///< rpf compare IMAGE... REFERENCE
Command add_report_command(CLI::App& app);    ///< rpf report IN OUT [REF] -o PAGE
Command add_explain_command(CLI::App& app);   ///< rpf explain FILE -o DIR
Command add_density_command(CLI::App& app);   ///< rpf density FILE -o IMAGE
Command add_adapt_command(CLI::App& app);     ///< rpf adapt FILE -- COMMAND
Command add_merge_command(CLI::App& app);     ///< rpf merge FILE FILE... -o FILE
Command add_convert_command(CLI::App& app);   ///< rpf convert FILE -o FILE
Command add_scene_command(CLI::App& app);     ///< rpf scene NAME -o FILE
Command add_devices_command(CLI::App& app);   ///< rpf devices
Command add_selftest_command(CLI::App& app);  ///< rpf selftest
Command add_bench_command(CLI::App& app);     ///< rpf bench frames | ab | sweep
Command add_study_command(CLI::App& app);     ///< rpf study NAME -o DIR

}  // namespace rpf::cli
