#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/needs.h"
#include "cli/sample_options.h"
#include "rpf/error.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

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
  check_need(file, "converting", write_rows_memory(*rows), read_options.max_memory,
             " or leave slots out with --map SLOT=");
  return write_and_tell(options.output, *rows, half_slots_of({file}));
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
