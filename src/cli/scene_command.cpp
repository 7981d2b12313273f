#include <fmt/format.h>

#include <tuple>

#include "cli/choices.h"
#include "cli/commands.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"
#include "rpf/scene.h"

namespace rpf::cli {
namespace {

struct Options {
  std::string name, output, size = "480x270", sampler = "random", density;
  int reference = 0;  ///< samples a pixel; 0: not asked for
  std::vector<float> world_offset = {0, 0, 0};
  std::string progress = "auto";
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  bool list = false, quiet = false;
  SceneOptions scene;  ///< the options that need no translation
};

SceneSampler sampler_of(const std::string& name) {
  if (name == "stratified") return SceneSampler::stratified;
  return name == "sobol" ? SceneSampler::sobol : SceneSampler::random;
}

SceneOptions scene_options(const Options& o) {
  SceneOptions scene = o.scene;
  std::tie(scene.width, scene.height) = size_of(o.size);
  scene.sampler = sampler_of(o.sampler);
  for (std::size_t axis = 0; axis < 3; ++axis) scene.world_offset[axis] = o.world_offset.at(axis);
  if (!o.density.empty()) scene.density = read_image(o.density, memory_limit(o.max_memory_mb));
  if (scene.threads == 0) scene.threads = default_threads();
  if (o.reference > 0) scene.samples = o.reference;
  return scene;
}

void print_list() {
  for (const SceneInfo& scene : scenes()) print("{:<15} {}\n", scene.name, scene.purpose);
}

void check_usage(const Options& o) {
  if (o.name.empty()) throw Error(ErrorKind::usage, "scene: no name; rpf scene --list says which scenes there are");
  if (o.output.empty())
    throw Error(ErrorKind::usage, "scene: no output; name the file to write with -o, as in -o dof.samples.exr");
}

PlannedOutput planned_output(const Options& o) {
  PlannedOutput output{o.output, o.reference > 0 ? OutputKind::image : OutputKind::samples};
  std::tie(output.window.width, output.window.height) = size_of(o.size);
  return output;
}

std::string progress_mode(const Options& o) { return o.quiet ? "never" : o.progress; }

/// More than the machine has is refused before anything is rendered.
RenderingLimit rendering_limit(const Options& o) {
  return {"scene", memory_limit(o.max_memory_mb), o.reference > 0 ? "--size" : "--spp or --size"};
}

void write_reference_image(const Options& o, const SceneOptions& scene) {
  check_reference_need(scene, rendering_limit(o));
  const Image image =
      with_progress(progress_mode(o), [&](const Control& c) { return render_reference(o.name, scene, c); });
  const SignalGuard guard;  // a signal now waits until the file is whole
  write_image(o.output, image);
  if (o.quiet) return;
  print("{}: {}x{} pixels, {} samples a pixel, residual relMSE {:.3g}\n", o.output, scene.width, scene.height,
        scene.samples, std::get<float>(image.metadata.at(residual_attribute)));
}

void write_sample_file(const Options& o, const SceneOptions& scene) {
  const auto rows = open_scene_within(o.name, scene, rendering_limit(o));
  with_progress(progress_mode(o), [&](const Control& c) { write_sample_rows(o.output, *rows, {}, c); });
  if (o.quiet) return;
  print("{}: {}x{} pixels, {} samples\n", o.output, scene.width, scene.height, rows->sample_count());
}

int run(const Options& o) {
  if (o.list) {
    print_list();
    return 0;
  }
  check_usage(o);
  check_outputs({planned_output(o)}, o.density.empty() ? std::vector<std::string>{} : std::vector{o.density});
  const SceneOptions scene = scene_options(o);
  if (o.reference > 0)
    write_reference_image(o, scene);
  else
    write_sample_file(o, scene);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

void add_options(CLI::App& command, Options& o) {
  command.add_option("NAME", o.name, "Which scene");
  command.add_flag("--list", o.list, "Say which scenes there are and what for");
  command.add_option("-o,--output", o.output, "Sample file to write, or with --reference the image")
      ->type_name("FILE.exr");
  restrict_to(command.add_option("--spp", o.scene.samples, "Samples a pixel"), ranges::samples)->capture_default_str();
  CLI::Option* reference = restrict_to(command.add_option("--reference", o.reference,
                                                          "Write the mean of N samples a pixel as an image instead"),
                                       ranges::reference_samples)
                               ->type_name("N");
  command.add_option("--size", o.size, "Pixels")->type_name("WxH")->capture_default_str();
  restrict_to(command.add_option("--seed", o.scene.seed, "Seed of the random numbers"), ranges::seed)
      ->capture_default_str();
  command.add_option("--sampler", o.sampler, "random, stratified, sobol")
      ->check(one_of({"random", "stratified", "sobol"}))
      ->capture_default_str();
  CLI::Option* adaptive =
      command.add_flag("--adaptive", o.scene.adaptive, "Counts vary: 0 to 2 * spp samples, all equally likely");
  command.add_option("--density", o.density, "Counts vary: spp * this image's first channel")
      ->type_name("FILE")
      ->excludes(adaptive)
      ->excludes(reference);
  adaptive->excludes(reference);
  command
      .add_flag("--penumbra", o.scene.penumbra,
                "Also write how wide shadows' edges are, which rpf --method axis-aligned needs")
      ->excludes(reference);
  command
      .add_flag("--lightfield", o.scene.lightfield,
                "Also write how surfaces move and where camera and lens are, which rpf --method lightfield needs")
      ->excludes(reference);
}

void add_world_options(CLI::App& command, Options& o) {
  restrict_to(command.add_option("--world-scale", o.scene.world_scale, "Positions written are scaled by this"),
              ranges::world_scale)
      ->capture_default_str();
  restrict_to(command.add_option("--world-offset", o.world_offset, "and moved by this"), ranges::world_offset)
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->default_str("0,0,0");
  restrict_to(command.add_option("-t,--threads", o.scene.threads, "Threads; all cores if not given"), ranges::threads,
              "RPF_NUM_THREADS");
  add_memory_option(command, o.max_memory_mb);
  command.add_option("--progress", o.progress, "auto, never, always")
      ->check(one_of({"auto", "never", "always"}))
      ->capture_default_str();
  command.add_flag("-q,--quiet", o.quiet, "Only errors");
}

}  // namespace

Command add_scene_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("scene", "Render a synthetic scene: samples, or a reference");
  add_options(*command, *options);
  add_world_options(*command, *options);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
