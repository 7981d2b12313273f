#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/needs.h"
#include "cli/sample_options.h"
#include "rpf/error.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

std::vector<RowsPart> open_parts(const SampleFileOptions& options, const SampleReadOptions& read_options) {
  std::vector<RowsPart> parts;
  for (const std::string& input : options.inputs) parts.push_back({input, open_sample_rows(input, read_options)});
  return parts;
}

/// Bytes of some rows of all parts, and of as many of the result.
std::uint64_t merging_memory(const std::vector<RowsPart>& parts) {
  std::uint64_t bytes = 0;
  for (const RowsPart& part : parts) bytes += 2 * write_rows_memory(*part.rows);
  return bytes;
}

int run(const SampleFileOptions& options) {
  if (options.inputs.size() < 2)
    throw Error(ErrorKind::usage, "merge: two or more sample files are expected, as in rpf merge a.exr b.exr -o c.exr");
  const SampleReadOptions read_options = read_options_of(options);
  std::vector<SampleFileInfo> files;
  for (const std::string& input : options.inputs) files.push_back(inspect_samples(input, read_options));
  check_outputs({{options.output, OutputKind::samples, {}, {}, true}}, options.inputs);
  for (const SampleFileInfo& file : files) {
    check_in_place(file, options.output);
    tell_dropped(file);
  }
  std::vector<RowsPart> parts = open_parts(options, read_options);
  check_need(files.front(), "merging", merging_memory(parts), read_options.max_memory,
             ", merge fewer or leave slots out with --map SLOT=");
  return write_and_tell(options.output, *merge_rows(std::move(parts)), half_slots_of(files));
}

}  // namespace

Command add_merge_command(CLI::App& app) {
  auto options = std::make_shared<SampleFileOptions>();
  CLI::App* command = app.add_subcommand("merge", "Join the samples of renderings of one frame with different seeds");
  add_sample_file_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
