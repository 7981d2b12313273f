#include "cli/sample_options.h"

#include <algorithm>

#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"

namespace rpf::cli {
namespace {

bool is_half(const SampleFileInfo& file, const std::string& slot) {
  return std::any_of(file.channels.begin(), file.channels.end(), [&](const SampleFileChannel& channel) {
    return channel.slot == slot && channel.type == PixelType::half_float;
  });
}

}  // namespace

void add_sample_file_options(CLI::App& command, SampleFileOptions& options) {
  command.add_option("INPUT", options.inputs, "Sample file")->required()->type_name("FILE");
  command.add_option("-o,--output", options.output, "Sample file to write")->required()->type_name("FILE");
  add_map_option(command, options.map);
  add_memory_option(command, options.max_memory_mb);
}

SampleReadOptions read_options_of(const SampleFileOptions& options) {
  return read_options_of(options.map, memory_limit(options.max_memory_mb));
}

std::vector<std::string> half_slots_of(const std::vector<SampleFileInfo>& files) {
  std::vector<std::string> slots;
  for (const SampleFileChannel& channel : files.front().channels)
    if (!channel.slot.empty() && std::all_of(files.begin(), files.end(),
                                             [&](const SampleFileInfo& file) { return is_half(file, channel.slot); }))
      slots.push_back(channel.slot);
  return slots;
}

int write_and_tell(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots) {
  with_progress("auto", [&](const Control& control) { write_sample_rows(path, rows, half_slots, control); });
  const SampleBuffer& frame = rows.frame();
  print("{}: {}x{} pixels, {} samples of {} slots\n", path, frame.data_window.width, frame.data_window.height,
        rows.sample_count(), frame.layout.size());
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace rpf::cli
