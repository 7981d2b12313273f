#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/density.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

struct Options {
  std::string input, output, estimate;
  std::vector<std::string> map;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  int samples = 4;
};

Image density_of(const Options& o, const SampleReadOptions& reading) {
  const SampleBuffer samples = read_samples(o.input, reading);
  tell_not_finite(samples);
  if (o.estimate.empty()) return sample_density(samples, o.samples);
  return sample_density(samples, o.samples, read_image(o.estimate, reading.max_memory));
}

/// Samples as they are read, some numbers a pixel, and the estimate.
std::uint64_t bytes_of(const SampleFileInfo& info, std::size_t slots, const std::string& estimate) {
  constexpr std::uint64_t numbers = 12;
  return info.sample_count * (slots + spare_columns) * sizeof(float) +
         info.data_window.pixel_count() * numbers * sizeof(double) +
         (estimate.empty() ? 0 : image_bytes(inspect_image(estimate)));
}

std::vector<std::string> inputs_of(const Options& o) {
  return o.estimate.empty() ? std::vector<std::string>{o.input} : std::vector<std::string>{o.input, o.estimate};
}

int run(const Options& o) {
  SampleReadOptions read_options = read_options_of(o.map, memory_limit(o.max_memory_mb));
  read_options.slots = std::vector<std::string>{"R", "G", "B", "film.X", "film.Y"};
  const SampleFileInfo info = inspect_samples(o.input, read_options);
  check_need(info, "density", bytes_of(info, read_options.slots->size(), o.estimate), read_options.max_memory, "");
  check_outputs({{o.output, OutputKind::image, {"Y"}, info.data_window}}, inputs_of(o));
  const Image density = density_of(o, read_options);
  const SignalGuard guard;  // a signal now waits until the file is whole
  write_image(o.output, density);
  const auto [least, most] = std::minmax_element(density.pixels.begin(), density.pixels.end());
  print("{}: {}x{} pixels, {} samples a pixel, {:g} to {:g}\n", o.output, info.data_window.width,
        info.data_window.height, o.samples, *least, *most);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_density_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "density", "Say how many samples each pixel should get in the next round, for rpf scene --spp 1 --density");
  command->add_option("INPUT", options->input, "Sample file")->required()->type_name("FILE");
  command->add_option("-o,--output", options->output, "Image to write, one channel of whole numbers")
      ->required()
      ->type_name("FILE.exr");
  command
      ->add_option("--error", options->estimate,
                   "What a method leaves counts too: its estimate, as filtering with --aov FILE --error writes it")
      ->type_name("FILE");
  add_map_option(*command, options->map);
  add_memory_option(*command, options->max_memory_mb);
  restrict_to(command->add_option("--spp", options->samples, "Samples a pixel of the round, on average"),
              ranges::samples)
      ->capture_default_str();
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
