#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/frame_part.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/io.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

struct JoinOptions {
  std::vector<std::string> inputs;
  std::string output;
};

int run(const JoinOptions& options) {
  check_outputs({{options.output}}, options.inputs);
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
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
