#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/frame_run.h"
#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/feature_files.h"
#include "cli/filter_input.h"
#include "cli/filter_options.h"
#include "cli/method_options.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "rpf/outputs.h"
#include "rpf/presets.h"

namespace rpf::cli {
namespace {

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

/// Needs more than the limit: refused before anything is read.
void check_budget(const FilterInput& input, const Settings& settings, bool tell) {
  const auto need = std::max(predicted_memory(input.info, settings), input.image_bytes);
  const double need_mb = static_cast<double>(need) / megabyte,
               limit_mb = static_cast<double>(settings.max_memory) / megabyte;
  if (tell) print("peak memory: {:.0f} MB of at most {:.0f} MB, {} threads\n", need_mb, limit_mb, settings.threads);
  check_need(input.info, "filtering", need, settings.max_memory);
}

/// What a pass with fixed weights did.
void print_fixed_weights(const Report& report, Method method) {
  print("backend {}\nmethod: {}\nfeatures: {}\n", report.backend, name_of(method), list(report.features));
  print("{:>4} {:>4} {:>9} {:>7} {:>8}\n", "pass", "box", "neighbors", "energy", "seconds");
  for (std::size_t i = 0; i < report.passes.size(); ++i) {
    const PassReport& p = report.passes[i];
    print("{:>4} {:>4} {:>9.1f} {:>7.4f} {:>8.2f}\n", i + 1, p.box_width, p.neighbors, p.energy, p.seconds);
  }
}

void print_learned(const Report& report) {
  print("backend {}\nnetwork: {} ({})\nrandom parameters: {}\nfeatures: {}\n", report.backend, report.model,
        report.model_hash, list(report.random), list(report.features));
  if (!report.dropped.empty()) print("constant, not looked at: {}\n", list(report.dropped));
  print("energy {:.4f}\n", report.passes.front().energy);
}

void print_report(const Report& report) {
  print("backend {}\nrandom parameters: {}\nfeatures: {}\n", report.backend, list(report.random),
        list(report.features));
  if (!report.dropped.empty()) print("constant, not modeled: {}\n", list(report.dropped));
  if (!report.uninformative.empty()) print("without information, not modeled: {}\n", list(report.uninformative));
  print("{:>4} {:>4} {:>9} {:>11} {:>6} {:>6} {:>6} {:>7} {:>8}\n", "pass", "box", "neighbors", "acceptance", "W",
        "alpha", "beta", "energy", "seconds");
  for (std::size_t i = 0; i < report.passes.size(); ++i) {
    const PassReport& p = report.passes[i];
    print("{:>4} {:>4} {:>9.1f} {:>11.3f} {:>6.3f} {:>6.3f} {:>6.3f} {:>7.4f} {:>8.2f}\n", i + 1, p.box_width,
          p.neighbors, p.acceptance, p.fraction_random, p.alpha, p.beta, p.energy, p.seconds);
  }
}

void write_results(const FilterOptions& options, const Result& result) {
  const SignalGuard guard;  // a signal now waits until the files are whole
  write_image(options.output, result.image);
  if (!options.aov.empty()) write_features(options.aov, result.features);
}

/// The files that will be written, known before the work.
std::vector<PlannedOutput> planned_outputs(const FilterOptions& options, const FilterInput& input,
                                           const Settings& settings) {
  const SampleFileInfo& info = input.info;
  const Window window = settings.crop.value_or(info.data_window);
  std::vector<PlannedOutput> outputs;
  if (!options.output.empty())
    outputs.push_back({options.output, OutputKind::image, {"R", "G", "B", "A"}, window, input.is_image()});
  if (options.aov.empty()) return outputs;
  std::vector<std::string> features;
  for (const std::string& slot : needed_layout(info, settings).slots)
    if (is_feature_slot(slot)) features.push_back(slot.substr(slot.find('.') + 1));
  for (const PlannedOutput& file : planned_features(options.aov, features, window)) outputs.push_back(file);
  return outputs;
}

void check_usage(const FilterOptions& options) {
  if (options.input.empty())
    throw Error(ErrorKind::usage, "no input: name a sample file, as in rpf render.samples.exr -o filtered.exr");
  if (options.output.empty() && !options.dry_run)
    throw Error(ErrorKind::usage, "no output: name the image to write with -o, as in -o filtered.exr");
}

void check_features(const FilterOptions& options, const SampleFileInfo& info) {
  const auto is_feature = [](const SampleFileChannel& channel) { return is_feature_slot(channel.slot); };
  if (!options.aov.empty() && std::none_of(info.channels.begin(), info.channels.end(), is_feature))
    throw Error(ErrorKind::usage, fmt::format("--aov: \"{}\" has no features; leave it out", info.path));
}

/// The settings of the preset that fits into what is left of the time budget, with the options given beside it.
Settings settings_within(double seconds, const SampleBuffer& samples, const Settings& settings,
                         const FilterOptions& options, const std::vector<std::string>& arguments) {
  const auto times =
      with_progress("never", [&](const Control& control) { return predict_presets(samples, settings, control); });
  const PresetTime best = best_within(times, seconds);
  if (!options.quiet)
    print("preset {}: predicted to take {:.2g} s{}\n", best.name, best.seconds,
          best.seconds > seconds ? ", more than the time budget; none is faster" : "");
  return settings_of(parse_filter_options(arguments, best.name));
}

void print_summary(const FilterOptions& options, const SampleFileInfo& info, const Report& report, double cpu,
                   double reading) {
  const Method method = options.settings.method;
  if (options.verbose && method == Method::rpf) print_report(report);
  if (options.verbose && method == Method::learned) print_learned(report);
  if (options.verbose && method != Method::rpf && method != Method::learned) print_fixed_weights(report, method);
  const std::string how =
      method == Method::learned ? "network " + report.model : fmt::format("{} passes", report.passes.size());
  print("{}: {}x{} pixels, {} samples, {} in {:.1f} s ({:.1f} CPU seconds, {:.1f} of them reading)\n", options.output,
        info.data_window.width, info.data_window.height, info.sample_count, how, report.seconds, cpu, reading);
}

int run(const FilterOptions& options, const std::vector<std::string>& arguments) {
  const bench::CostClock clock;
  check_usage(options);
  const double budget = time_budget_of(options);
  Settings settings = settings_of(options);
  SampleReadOptions read_options = read_options_of(options.map, settings.max_memory);
  const FilterInput input = open_input(options.input, settings.method, read_options);
  const SampleFileInfo& info = input.info;
  if (input.is_image() && options.sigma_color == 0) settings.sigma_color = image_sigma_color;
  check_features(options, info);
  check_budget(input, settings, options.verbose || options.dry_run);
  if (settings.crop) check_crop(*settings.crop, info.data_window);
  check_outputs(planned_outputs(options, input, settings), {options.input});
  const SampleFileInfo stored = as_image(info, options.output);
  check_in_place(stored, options.output);
  if (!options.quiet) tell_dropped(stored);
  if (options.dry_run) return 0;

  read_options.slots = needed_layout(info, settings).slots;
  SampleBuffer samples = read_input(input, read_options);
  const bench::Cost reading = clock.elapsed();
  if (budget > 0) settings = settings_within(budget - reading.wall, samples, settings, options, arguments);
  const Result result = with_progress(options.quiet ? "never" : options.progress, [&](const Control& control) {
    return filter(std::move(samples), settings, control);
  });
  write_results(options, result);
  if (!options.quiet) print_notes(result.report);
  if (!options.quiet && settings.backend == "auto") print("backend {}\n", result.report.backend);
  if (!options.quiet) print_summary(options, info, result.report, clock.elapsed().cpu, reading.cpu);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_filter_command(CLI::App& app, const std::vector<std::string>& arguments) {
  auto options = std::make_shared<FilterOptions>();
  start_from_named_settings(arguments, {}, *options);
  add_filter_options(app, *options);
  return [options, arguments] { return run(*options, arguments); };
}

}  // namespace rpf::cli
