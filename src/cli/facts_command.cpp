#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/facts_file.h"
#include "cli/filter_input.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

int run(const FilterOptions& options) {
  if (!options.time_budget.empty())
    throw Error(ErrorKind::usage, "facts: --time-budget leaves open which preset it is; name one with --preset");
  const Settings settings = settings_of(options);
  SampleReadOptions reading = read_options_of(options, settings);
  const SampleFileInfo info = inspect_samples(options.input, reading);
  reading.slots = needed_layout(info, settings).slots;
  check_outputs({{options.output, OutputKind::page}}, files_read(options));
  const auto rows = open_sample_rows(options.input, reading);
  FactsFile file;
  file.facts = with_progress(options.quiet ? "never" : options.progress,
                             [&](const Control& control) { return find_facts(*rows, settings, control); });
  file.origin = frame_origin(hash_of_file(options.input), settings, options.map);
  file.ends = hash_of_ends(options.input);
  const SignalGuard guard;  // a signal now waits until the file is whole
  write_facts(options.output, file);
  if (!options.quiet)
    print("{}: facts of {}x{} pixels, {} samples\n", options.output, info.data_window.width, info.data_window.height,
          info.sample_count);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_facts_command(CLI::App& app, const std::vector<std::string>& arguments) {
  auto options = std::make_shared<FilterOptions>();
  start_from_named_settings(arguments, {}, *options);
  CLI::App* command = app.add_subcommand(
      "facts", "Find what filtering needs of a whole frame, so that parts of it can be filtered by several machines");
  command->add_option("INPUT", options->input, "Sample file (deep OpenEXR or raw floats)")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", options->output, "Facts to write, for rpf --facts")
      ->required()
      ->type_name("FILE.json");
  command->add_option("--aov", options->aov, "Any name, where parts are filtered with --aov")->type_name("FILE|DIR");
  add_map_option(*command, options->map);
  add_picture_options(*command, *options);
  add_machine_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
