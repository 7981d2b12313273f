#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/frame_part.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/io.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

struct JoinOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
};

/// All parts, and the picture that they become: refused before anything is read.
void check_memory(const JoinOptions& options) {
  std::uint64_t parts = 0;
  for (const std::string& path : options.inputs) parts += image_bytes(inspect_image(path));
  check_images_need("join", options.inputs.size(), 2 * parts, memory_limit(options.max_memory_mb));
}

int run(const JoinOptions& options) {
  check_outputs({{options.output}}, options.inputs);
  check_memory(options);
  const Image image = joined(options.inputs);
  check_outputs({{options.output, OutputKind::image, image.channels, image.data_window}}, options.inputs);
  const SignalGuard guard;  // a signal now waits until the file is whole
  write_image(options.output, image);
  print("{}: {}x{} pixels of {} parts\n", options.output, image.data_window.width, image.data_window.height,
        options.inputs.size());
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_join_command(CLI::App& app) {
  auto options = std::make_shared<JoinOptions>();
  CLI::App* command = app.add_subcommand("join", "Join parts of one frame that rpf --rows wrote");
  command->add_option("PART", options->inputs, "Images of all rows of a frame, in any order (exr)")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", options->output, "Image to write")->required()->type_name("FILE");
  add_memory_option(*command, options->max_memory_mb);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
