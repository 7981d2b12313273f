#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/sample_options.h"
#include "rpf/error.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

/// Some rows are in memory at once; a row may be too long for it.
void check_budget(const std::string& input, std::uint64_t need, std::uint64_t limit) {
  if (need > limit)
    throw Error(ErrorKind::memory,
                fmt::format("{}: converting needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory or leave slots "
                            "out with --map SLOT=",
                            input, static_cast<double>(need) / megabyte, static_cast<double>(limit) / megabyte));
}

int run(const SampleFileOptions& options) {
  if (options.inputs.size() != 1)
    throw Error(ErrorKind::usage, "convert: one sample file is expected; rpf merge joins several");
  const std::string& input = options.inputs.front();
  const SampleReadOptions read_options = read_options_of(options);
  const SampleFileInfo file = inspect_samples(input, read_options);
  check_outputs({{options.output, OutputKind::samples, {}, {}, true}}, {input});
  check_in_place(file, options.output);
  tell_dropped(file);
  const auto rows = open_sample_rows(input, read_options);
  check_budget(input, write_rows_memory(*rows), read_options.max_memory);
  with_progress("auto", [&](const Control& control) {
    write_sample_rows(options.output, *rows, half_slots_of({file}), control);
  });
  return tell_written(options.output, rows->frame(), file.sample_count);
}

}  // namespace

Command add_convert_command(CLI::App& app) {
  auto options = std::make_shared<SampleFileOptions>();
  CLI::App* command = app.add_subcommand(
      "convert", "Write samples as deep OpenEXR (.exr) or raw floats (.rpf), with the slots' own names");
  add_sample_file_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
