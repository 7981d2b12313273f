#include <fmt/format.h>

#include "bench/frame_run.h"
#include "cli/commands.h"
#include "cli/filter_frame.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/sequence.h"
#include "cli/signals.h"
#include "rpf/presets.h"

namespace rpf::cli {
namespace {

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

void print_summary(const OpenFrame& frame, const Report& report, double cpu, double reading) {
  const FilterOptions& options = frame.options;
  const SampleFileInfo& info = frame.input.info;
  if (options.verbose) print_report(report, options.settings.method);
  const std::string how = options.settings.method == Method::learned ? "network " + report.model
                                                                     : fmt::format("{} passes", report.passes.size());
  print("{}: {}x{} pixels, {} samples, {} in {:.1f} s ({:.1f} CPU seconds, {:.1f} of them reading)\n", options.output,
        info.data_window.width, info.data_window.height, info.sample_count, how, report.seconds, cpu, reading);
}

int run(const FilterOptions& options, const std::vector<std::string>& arguments) {
  const bench::CostClock clock;
  const double budget = time_budget_of(options);
  const OpenFrame frame = open_frame(options);
  if (options.dry_run) return 0;
  ReadFrame read = read_frame(frame);
  const bench::Cost reading = clock.elapsed();
  Settings settings = frame.settings;
  if (budget > 0) settings = settings_within(budget - reading.wall, read.samples, settings, options, arguments);
  const Result result = filter_and_write(frame, settings, std::move(read));
  if (!options.quiet) print_notes(result.report);
  if (!options.quiet && settings.backend == "auto") print("backend {}\n", result.report.backend);
  if (!options.quiet) print_summary(frame, result.report, clock.elapsed().cpu, reading.cpu);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_filter_command(CLI::App& app, const std::vector<std::string>& arguments) {
  auto options = std::make_shared<FilterOptions>();
  auto sequence = std::make_shared<SequenceOptions>();
  start_from_named_settings(arguments, {}, *options);
  add_filter_options(app, *options);
  add_sequence_options(app, *sequence);
  return
      [=] { return is_sequence(*options, *sequence) ? run_sequence(*options, *sequence) : run(*options, arguments); };
}

}  // namespace rpf::cli
