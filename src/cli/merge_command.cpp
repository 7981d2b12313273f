#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/print.h"
#include "cli/sample_options.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

std::size_t slot_count(const SampleFileInfo& file) {
  std::size_t count = 0;
  for (const SampleFileChannel& channel : file.channels) count += channel.slot.empty() ? 0 : 1;
  return count;
}

/// Needs more than the limit: refused before anything is read.
void check_budget(const std::vector<SampleFileInfo>& files, std::uint64_t limit) {
  std::uint64_t samples = 0, pixels = 0;
  std::size_t slots = 0;
  for (const SampleFileInfo& file : files) {
    samples += file.sample_count;
    pixels = std::max(pixels, static_cast<std::uint64_t>(file.data_window.pixel_count()));
    slots = std::max(slots, slot_count(file));
  }
  const std::uint64_t need = merging_bytes(pixels, samples, slots, files.size());
  if (need > limit)
    throw Error(
        ErrorKind::memory,
        fmt::format("merge: {} files need {:.0f} MB, the limit is {:.0f} MB; raise --max-memory, merge fewer or "
                    "leave slots out with --map SLOT=",
                    files.size(), static_cast<double>(need) / megabyte, static_cast<double>(limit) / megabyte));
}

int run(const SampleFileOptions& options) {
  if (options.inputs.size() < 2)
    throw Error(ErrorKind::usage, "merge: two or more sample files are expected, as in rpf merge a.exr b.exr -o c.exr");
  const SampleReadOptions read_options = read_options_of(options);
  std::vector<SampleFileInfo> files;
  for (const std::string& input : options.inputs) files.push_back(inspect_samples(input, read_options));
  check_budget(files, read_options.max_memory);
  check_outputs({{options.output, OutputKind::samples, {}, {}, true}}, options.inputs);
  for (const SampleFileInfo& file : files) {
    check_in_place(file, options.output);
    tell_dropped(file);
  }
  std::vector<SamplePart> parts;
  for (const std::string& input : options.inputs) parts.push_back({input, read_samples(input, read_options)});
  return write_and_tell(options.output, merge_samples(std::move(parts)), half_slots_of(files));
}

}  // namespace

Command add_merge_command(CLI::App& app) {
  auto options = std::make_shared<SampleFileOptions>();
  CLI::App* command = app.add_subcommand("merge", "Join the samples of renderings of one frame with different seeds");
  add_sample_file_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
