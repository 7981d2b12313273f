#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "cli/commands.h"
#include "cli/environment.h"
#include "cli/explain_maps.h"
#include "cli/explain_pages.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/result_folder.h"
#include "cli/signals.h"
#include "report/plot.h"
#include "rpf/error.h"
#include "rpf/explain.h"
#include "rpf/outputs.h"
#include "rpf/presets.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  FilterOptions filter;                    ///< those that this command shares with filtering
  std::string pixel, preset = "balanced";  ///< whose picture of the pixel is explained
  int box = 0;
};

PixelPosition pixel_of(const std::string& text) {
  PixelPosition pixel;
  int used = 0;
  const bool parsed = std::sscanf(text.c_str(), "%d,%d%n", &pixel.x, &pixel.y, &used) == 2;
  if (!parsed || used != static_cast<int>(text.size()))
    throw Error(ErrorKind::usage, fmt::format("--pixel {}: X,Y is expected, such as 120,80", text));
  return pixel;
}

Settings settings_of(const Options& o) {
  Settings settings = settings_of(o.filter);
  if (o.box > 0) settings.box_widths = {o.box};
  return settings;
}

/// The folder to write to; it is made in the end, inside one that exists.
fs::path folder_of(const Options& o) { return (fs::path(o.filter.output) / "").parent_path(); }

PlannedOutput planned(const fs::path& path, OutputKind kind) {
  return {path.string(), kind, {"R", "G", "B"}, {}, false, true};
}

/// The page of a pixel and, where its folder is there, the pictures in it. Others follow from what the pass finds: one
/// that there always is stands for them.
std::vector<PlannedOutput> planned_outputs(const fs::path& folder, const PixelPosition& pixel) {
  const std::string name = pixel_page_name(pixel);
  std::vector<PlannedOutput> outputs = {planned(folder / (name + ".html"), OutputKind::page)};
  std::error_code unknown;
  if (!fs::exists(folder / name, unknown)) return outputs;
  const fs::path always = folder / name / "box.png";
  outputs.push_back(planned(always, OutputKind::image));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / name, unknown))
    if (entry.path().extension() == ".png" && entry.path() != always)
      outputs.push_back(planned(entry.path(), OutputKind::image));
  return outputs;
}

/// Before an hour of work.
void check_files(const Options& o, const std::vector<std::string>& layers, const std::optional<PixelPosition>& pixel) {
  const fs::path folder = folder_of(o);
  std::vector<PlannedOutput> outputs = {planned(folder / "explain.exr", OutputKind::image),
                                        planned(folder / "density.exr", OutputKind::image),
                                        planned(folder / "index.html", OutputKind::page)};
  for (const std::string& name : map_names(layers))
    outputs.push_back(planned(folder / (name + ".png"), OutputKind::image));
  if (pixel)
    for (PlannedOutput& output : planned_outputs(folder, *pixel)) outputs.push_back(std::move(output));
  check_outputs(outputs, {o.filter.input});
}

/// Which samples the preset makes the pixel of; it is shown other channels than the published filter.
ExplainedEstimate estimate_of(const Options& o, const Settings& published, const SampleFileInfo& info,
                              const PixelPosition& pixel, const Control& control) {
  Settings settings = preset_settings(o.preset);
  settings.backend = published.backend;
  settings.device = published.device;
  settings.threads = published.threads;
  settings.max_memory = published.max_memory;
  SampleReadOptions read_options = read_options_of(o.filter, settings);
  read_options.slots = needed_layout(info, settings).slots;
  return explain_estimate(read_samples(o.filter.input, read_options), settings, pixel, control);
}

void write_pages(const Options& o, const Explanation& explanation, const std::optional<ExplainedEstimate>& estimate) {
  const SignalGuard guard;  // a signal now waits until the files are whole
  ResultFolder folder(folder_of(o));
  if (estimate) write_pixel_page(o.filter.output, o.filter.input, explanation, *estimate);
  write_explanation(o.filter.output, o.filter.input, explanation);
  folder.keep();
}

int run(const Options& o) {
  if (o.filter.input.empty() || o.filter.output.empty())
    throw Error(ErrorKind::usage,
                "explain: a sample file and a folder are expected, as in rpf explain "
                "render.samples.exr -o explained");
  const Settings settings = settings_of(o);
  std::optional<PixelPosition> pixel;
  if (!o.pixel.empty()) {
    pixel = pixel_of(o.pixel);
    report::check_plotting();
  }
  SampleReadOptions read_options = read_options_of(o.filter, settings);
  const SampleFileInfo info = inspect_samples(o.filter.input, read_options);
  const SampleLayout layout = needed_layout(info, settings);
  check_need(info, "explaining", predict_explain_memory(frame_size(info), layout, settings), settings.max_memory);
  check_files(o, explain_layers(layout, settings), pixel);
  read_options.slots = layout.slots;
  std::optional<ExplainedEstimate> estimate;
  const std::string progress = o.filter.quiet ? "never" : o.filter.progress;
  if (pixel)
    estimate = with_progress(progress,
                             [&](const Control& control) { return estimate_of(o, settings, info, *pixel, control); });
  SampleBuffer samples = read_samples(o.filter.input, read_options);
  const Explanation explanation = with_progress(
      progress, [&](const Control& control) { return explain(std::move(samples), settings, control, pixel); });
  write_pages(o, explanation, estimate);
  if (!o.filter.quiet) print_notes(explanation.report);
  if (!o.filter.quiet && settings.backend == "auto") print("backend {}\n", explanation.report.backend);
  if (!o.filter.quiet)
    print("{}: {} layers of {}x{} pixels in {:.1f} s\n", (fs::path(o.filter.output) / "index.html").string(),
          explanation.layers.channel_count(), info.data_window.width, info.data_window.height,
          explanation.report.seconds);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_explain_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("explain", "Show what the filter thinks of a frame, or of one pixel");
  start_from(explain_settings(), options->filter);
  command->add_option("-i,--input,INPUT", options->filter.input, "Sample file (deep OpenEXR or raw floats)")
      ->type_name("FILE");
  command->add_option("-o,--output", options->filter.output, "Folder for explain.exr, pictures and index.html")
      ->type_name("DIR");
  command->add_option("--pixel", options->pixel, "Also a page with everything about this pixel")->type_name("X,Y");
  add_preset_option(*command, options->preset);
  restrict_to(command->add_option("--box", options->box, "Box width of the pass that is explained"), ranges::box_width)
      ->default_str("21");
  add_map_option(*command, options->filter.map);
  add_channel_options(*command, options->filter);
  add_machine_options(*command, options->filter);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
