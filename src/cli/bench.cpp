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
#include "cli/signals.h"
#include "rpf/error.h"

namespace rpf::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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
  bench::make_scene_files(frame, stoppable());
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
