#include "cli/bench.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <tuple>

#include "cli/filter_options.h"
#include "cli/measuring.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/metrics.h"

namespace rpf::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// A file of a scene that is still to be rendered.
bool is_to_come(const bench::SweepFrame& frame, const std::string& file) {
  return !frame.scene.empty() && !fs::exists(file);
}

Window window_of(const bench::SweepFrame& frame) { return {0, 0, frame.width, frame.height}; }

/// Of samples that are still to be rendered: by rows, and then read whole and filtered.
void check_rendering(const bench::SweepFrame& frame, const bench::FrameJob& job, const RenderingLimit& limit) {
  const auto rows = open_scene_within(frame.scene, sample_options(frame), limit);
  SampleFileInfo info;
  info.path = frame.name;
  const FrameSize size{window_of(frame).pixel_count(), rows->sample_count(),
                       static_cast<std::uint32_t>(frame.samples_per_pixel), frame.width};
  check_need(info, "filtering", predict_memory(size, rows->frame().layout, job.settings), limit.bytes,
             fmt::format(" or choose a smaller {}", limit.smaller).c_str());
}

/// That the reference can be read or made, and shows what is filtered: the crop, or these samples.
void check_reference(const bench::SweepFrame& frame, const bench::FrameJob& job, const Window& samples,
                     const RenderingLimit& limit) {
  if (job.reference.empty()) return;
  const bool is_made = is_to_come(frame, job.reference);
  if (is_made) check_reference_need(sample_options(frame), limit);
  Image filtered, reference;
  filtered.channels = reference.channels = {"R", "G", "B"};
  filtered.data_window = job.settings.crop.value_or(samples);
  reference.data_window = window_of(frame);
  measuring(job.samples, job.reference,
            [&] { check_comparable(filtered, is_made ? reference : inspect_image(job.reference)); });
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "rpf-bench-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw Error(ErrorKind::output, fmt::format("no temporary folder {} can be made", pattern));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<bench::SweepFrame> frames_of(const BenchFrames& options, const std::string& folder) {
  if (!options.references.empty() && options.references.size() != options.files.size())
    throw Error(ErrorKind::usage, fmt::format("bench: {} files and {} references; one --reference for each file is "
                                              "expected, or none",
                                              options.files.size(), options.references.size()));
  std::vector<bench::SweepFrame> frames;
  for (std::size_t i = 0; i < options.files.size(); ++i) {
    bench::SweepFrame frame;
    frame.samples = options.files[i];
    frame.name = fs::path(frame.samples).filename().string();
    if (!options.references.empty()) frame.reference = options.references[i];
    frames.push_back(frame);
  }
  if (!frames.empty()) return frames;
  bench::SweepFrame frame;
  frame.scene = options.scene;
  frame.name = options.scene + " " + options.size;
  std::tie(frame.width, frame.height) = size_of(options.size);
  bench::name_scene_files(frame, folder);
  return {frame};
}

bench::SweepSetting setting_of(const std::string& text) {
  const auto equals = text.find('=');
  if (text.empty() || text[0] == '-' || equals == std::string::npos) return {text, text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

bench::FrameJob job_of(const bench::SweepFrame& frame, const bench::SweepSetting& setting) {
  FilterOptions options;
  try {
    options = parse_filter_options(CLI::detail::split_up(setting.options));
  } catch (const CLI::ParseError& e) {
    throw Error(ErrorKind::usage, fmt::format("setting \"{}\": {}", setting.name, e.what()));
  }
  const bool names_files =
      !options.input.empty() || std::any_of(std::begin(frame_files), std::end(frame_files),
                                            [&](const FrameFile& file) { return !(options.*file.path).empty(); });
  if (names_files || !options.rows.empty())
    throw Error(
        ErrorKind::usage,
        fmt::format("setting \"{}\": options that name files or a part of a frame have no place here", setting.name));
  const Settings settings = settings_of(options);
  return {frame.samples, frame.reference, settings, read_options_of(options, settings)};
}

void check_frame(const bench::SweepFrame& frame, const bench::FrameJob& job, const char* smaller) {
  if (frame.reference_samples != 0 && !ranges::reference_samples.has(frame.reference_samples))
    throw Error(ErrorKind::usage,
                fmt::format("reference_spp {}: {}", frame.reference_samples, ranges::reference_samples.expected()));
  const RenderingLimit limit{frame.name, job.read.max_memory, smaller};
  Window samples = window_of(frame);
  if (is_to_come(frame, job.samples))
    check_rendering(frame, job, limit);
  else
    samples = inspect_samples(job.samples, job.read).data_window;
  check_reference(frame, job, samples, limit);
}

Control stoppable() {
  Control control;
  control.progress = [](const Progress&) { return received_signal() == 0; };
  return control;
}

void show_status(const std::string& text) {
  if (isatty(STDERR_FILENO) != 1) return;
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
}

Json json_of(const bench::Summary& summary, const std::vector<double>& rounds) {
  return {{"median", summary.median}, {"lowest", summary.lowest}, {"highest", summary.highest}, {"rounds", rounds}};
}

}  // namespace rpf::cli
