#include "cli/filter_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/dropped.h"
#include "cli/feature_files.h"
#include "cli/frame_numbers.h"
#include "cli/frame_page.h"
#include "cli/frame_part.h"
#include "cli/method_options.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/methods.h"
#include "rpf/outputs.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

/// The need; more than the limit is refused before anything is read.
std::uint64_t check_budget(const FilterInput& input, const Settings& settings, bool tell, bool has_page) {
  const auto need = std::max(
      {predicted_memory(input.info, settings), input.image_bytes, has_page ? page_bytes(input.info, false) : 0});
  const double need_mb = static_cast<double>(need) / megabyte,
               limit_mb = static_cast<double>(settings.max_memory) / megabyte;
  if (tell) print("peak memory: {:.0f} MB of at most {:.0f} MB, {} threads\n", need_mb, limit_mb, settings.threads);
  check_need(input.info, "filtering", need, settings.max_memory);
  return need;
}

/// What a pass with fixed weights did.
void print_fixed_weights(const Report& report, Method method) {
  print("backend {}\nmethod: {}\nfeatures: {}\n", report.backend, name_of(method), listed(report.features));
  print("{:>4} {:>4} {:>9} {:>7} {:>8}\n", "pass", "box", "neighbors", "energy", "seconds");
  for (std::size_t i = 0; i < report.passes.size(); ++i) {
    const PassReport& p = report.passes[i];
    print("{:>4} {:>4} {:>9.1f} {:>7.4f} {:>8.2f}\n", i + 1, p.box_width, p.neighbors, p.energy, p.seconds);
  }
}

/// What a method that filters pixels did.
void print_pixel_method(const Report& report, Method method) {
  print("backend {}\nmethod: {}\nfeatures: {}\nenergy {:.4f}\n", report.backend, name_of(method),
        listed(report.features), report.passes.front().energy);
}

void print_learned(const Report& report) {
  print("backend {}\nnetwork: {} ({})\nrandom parameters: {}\nfeatures: {}\n", report.backend, report.model,
        report.model_hash, listed(report.random), listed(report.features));
  if (!report.dropped.empty()) print("constant, not looked at: {}\n", listed(report.dropped));
  print("energy {:.4f}\n", report.passes.front().energy);
}

void print_published(const Report& report) {
  print("backend {}\nrandom parameters: {}\nfeatures: {}\n", report.backend, listed(report.random),
        listed(report.features));
  if (!report.dropped.empty()) print("constant, not modeled: {}\n", listed(report.dropped));
  if (!report.uninformative.empty()) print("without information, not modeled: {}\n", listed(report.uninformative));
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

/// Whether a frame that does not fit is read by rows.
bool is_streamed(const OpenFrame& frame) {
  return can_stream(frame.settings) && !frame.input.is_image() && frame.options.report.empty() &&
         frame.options.time_budget.empty();
}

/// Of a frame that does not fit: what its rows take. Refuses where that is too much too.
std::uint64_t check_streamed(const OpenFrame& frame, const SampleReadOptions& reading, bool tell) {
  const auto rows = open_sample_rows(frame.options.input, reading);
  const RowsMemory need = predict_rows_memory(*rows, frame.input.info.max_samples, frame.settings);
  if (tell) print("{}\n", text_of(need));
  check_need(frame.input.info, "filtering, with rows read as they are needed,", need.bytes, frame.settings.max_memory);
  return need.bytes;
}

/// The files that will be written, known before the work.
std::vector<PlannedOutput> planned_outputs(const FilterOptions& options, const FilterInput& input,
                                           const Settings& settings) {
  const SampleFileInfo& info = input.info;
  const Window window = settings.crop.value_or(info.data_window);
  std::vector<PlannedOutput> outputs;
  if (!options.output.empty())
    outputs.push_back({options.output, OutputKind::image, {"R", "G", "B", "A"}, window, input.is_image()});
  if (!options.report.empty()) outputs.push_back({options.report, OutputKind::page});
  if (options.aov.empty()) return outputs;
  std::vector<std::string> features;
  for (const std::string& slot : needed_layout(info, settings).slots)
    if (is_feature_slot(slot)) features.push_back(name_in_group(slot));
  if (settings.estimate_error) features.emplace_back("error");
  for (const PlannedOutput& file : planned_features(options.aov, features, window)) outputs.push_back(file);
  return outputs;
}

/// Of one frame: the place for a frame's number would become a part of each name.
void check_names(const FilterOptions& options) {
  for (const FrameFile& file : frame_files)
    if (FramePattern(options.*file.path).has_place())
      throw Error(ErrorKind::usage, fmt::format("{} {}: has a place for the number of a frame, but \"{}\" is one file; "
                                                "name one file, or the input with a place too, such as in.####.exr",
                                                file.option, options.*file.path, options.input));
}

void check_usage(const FilterOptions& options) {
  if (options.input.empty())
    throw Error(ErrorKind::usage, "no input: name a sample file, as in rpf render.samples.exr -o filtered.exr");
  const bool is_word = options.input.find_first_of("/.") == std::string::npos;
  if (options.output.empty() && is_word && !std::filesystem::exists(options.input))
    throw Error(ErrorKind::usage, fmt::format("'{}' is no command and no file that is there; rpf --help lists the "
                                              "commands",
                                              options.input));
  if (options.output.empty() && !options.dry_run)
    throw Error(ErrorKind::usage, "no output: name the image to write with -o, as in -o filtered.exr");
  check_names(options);
}

void check_features(const FilterOptions& options, const SampleFileInfo& info) {
  const auto is_feature = [](const SampleFileChannel& channel) { return is_feature_slot(channel.slot); };
  if (!options.aov.empty() && !options.settings.estimate_error &&
      std::none_of(info.channels.begin(), info.channels.end(), is_feature))
    throw Error(ErrorKind::usage, fmt::format("--aov: \"{}\" has no features; leave it out", info.path));
}

/// What rpf join needs to know of a part stands in attributes of OpenEXR.
void check_part_name(const FilterOptions& options) {
  if (!options.rows.empty() && !options.output.empty() && !is_openexr(options.output))
    throw Error(ErrorKind::usage, fmt::format("--rows: \"{}\" could not be joined with the other parts; name an .exr "
                                              "file",
                                              options.output));
}

/// A part of a frame, or a whole one of which facts are known.
void open_parts(OpenFrame& frame) {
  const FilterOptions& options = frame.options;
  if (options.rows.empty() && options.facts.empty()) return;
  const char* option = options.rows.empty() ? "--facts" : "--rows";
  if (frame.input.is_image())
    throw Error(ErrorKind::usage,
                fmt::format("{}: \"{}\" is an image; only samples are read by rows", option, options.input));
  if (needs_whole_frame(frame.settings.method))
    throw Error(ErrorKind::usage, fmt::format("{}: method {} filters the whole frame at once; leave it out", option,
                                              name_of(frame.settings.method)));
  if (frame.settings.estimate_error)
    throw Error(ErrorKind::usage, fmt::format("{}: --error needs the whole frame; leave one of them out", option));
  if (!options.report.empty() || !options.time_budget.empty())
    throw Error(ErrorKind::usage, fmt::format("{}: {} needs the whole frame; leave one of them out", option,
                                              options.report.empty() ? "--time-budget" : "--report"));
  check_part_name(options);
  frame.by_rows = true;
  if (!options.facts.empty()) frame.facts = read_facts(options.facts, options.input, frame.settings, options.map);
  if (!options.rows.empty()) frame.settings.crop = rows_of(options.rows, frame.input.info.data_window);
}

}  // namespace

OpenFrame open_frame(const FilterOptions& options) {
  check_usage(options);
  OpenFrame frame{options, settings_of(options), {}, {}, 0, false, {}};
  frame.reading = read_options_of(options, frame.settings);
  frame.input = open_input(options.input, frame.settings.method, frame.reading);
  const SampleFileInfo& info = frame.input.info;
  if (frame.input.is_image() && options.sigma_color == 0) frame.settings.sigma_color = image_sigma_color;
  check_features(options, info);
  open_parts(frame);
  const bool tell = options.verbose || options.dry_run;
  frame.reading.slots = needed_layout(info, frame.settings).slots;
  frame.by_rows =
      frame.by_rows || (is_streamed(frame) && predicted_memory(info, frame.settings) > frame.settings.max_memory);
  if (!frame.by_rows)
    frame.need = check_budget(frame.input, frame.settings, tell, !options.report.empty());
  else if (options.rows.empty() && options.facts.empty())
    frame.need = check_streamed(frame, frame.reading, tell);
  if (frame.settings.crop) check_crop(*frame.settings.crop, info.data_window);
  check_outputs(planned_outputs(options, frame.input, frame.settings), files_read(options));
  const SampleFileInfo stored = as_image(info, options.output);
  check_in_place(stored, options.output);
  if (!options.quiet) tell_dropped(stored);
  return frame;
}

std::uint64_t read_bytes(const OpenFrame& frame) {
  if (frame.by_rows) return 0;
  const SampleFileInfo& info = frame.input.info;
  const std::uint64_t columns = frame.reading.slots->size() + spare_columns;
  return (info.sample_count * columns + info.data_window.pixel_count()) * sizeof(float);
}

Origin origin_of(const OpenFrame& frame) {
  if (!frame.facts.facts.empty()) return frame.facts.origin;
  const FilterOptions& options = frame.options;
  const std::string hash = hash_of_file(options.input);
  if (!options.rows.empty()) return frame_origin(hash, frame.settings, options.map);
  return {hash, hash_of_settings(frame.settings, options.map)};
}

bool is_wanted(const OpenFrame& frame, const Image& image) {
  return frame.options.rows.empty() || is_part(image, *frame.settings.crop, frame.input.info.data_window);
}

ReadFrame read_frame(const OpenFrame& frame) {
  if (frame.by_rows) return {{}, origin_of(frame)};
  return {read_input(frame.input, frame.reading), origin_of(frame)};
}

Result filter_and_write(const OpenFrame& frame, const Settings& settings, ReadFrame read) {
  const FilterOptions& options = frame.options;
  const bench::CostClock clock;
  Result result = with_progress(options.quiet ? "never" : options.progress, [&](const Control& control) {
    if (!frame.by_rows) return filter(std::move(read.samples), settings, control);
    const auto rows = open_sample_rows(options.input, frame.reading);
    return filter_rows(*rows, settings, frame.facts.facts, control);
  });
  for (Image* image : {&result.image, &result.features}) {
    mark(*image, read.origin);
    if (!options.rows.empty()) mark_part(*image, frame.input.info.data_window);
  }
  write_results(options, result);
  if (!options.report.empty())
    write_frame_page({options.input, options.output, "", options.report, frame.reading, settings,
                      options.quiet ? "never" : options.progress,
                      RunFigures{result.report, settings.method, clock.elapsed(), frame.need, peak_memory()}});
  return result;
}

void print_report(const Report& report, Method method) {
  if (method == Method::rpf)
    print_published(report);
  else if (method == Method::learned)
    print_learned(report);
  else if (needs_whole_frame(method))
    print_pixel_method(report, method);
  else
    print_fixed_weights(report, method);
}

}  // namespace rpf::cli
