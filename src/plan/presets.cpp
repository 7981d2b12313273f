#include "rpf/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include "rpf/error.h"

namespace rpf {
namespace {

/// The part of a frame that is filtered to predict the rest: large enough to outweigh what a run costs before its first
/// pixel.
constexpr int trial_width = 128, trial_height = 72;

struct Preset {
  const char* name;  ///< and its network's
  const char* purpose;
};

constexpr Preset all_presets[] = {
    {"fast", "previews and long sequences: the smallest network"},
    {"balanced", "most work"},
    {"high", "final frames: the widest network"},
};

Settings settings_of(const Preset& preset) {
  Settings settings;
  settings.method = Method::learned;
  settings.model = preset.name;
  return settings;
}

/// The middle of a frame, at most trial_width x trial_height pixels.
SampleBuffer middle_of(const SampleBuffer& samples) {
  const Window& all = samples.data_window;
  SampleBuffer part;
  part.layout = samples.layout;
  part.data_window.width = std::min(all.width, trial_width);
  part.data_window.height = std::min(all.height, trial_height);
  part.data_window.x = all.x + (all.width - part.data_window.width) / 2;
  part.data_window.y = all.y + (all.height - part.data_window.height) / 2;
  part.display_window = part.data_window;
  part.first_sample = {0};
  for (int y = 0; y < part.data_window.height; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(part.data_window.y - all.y + y) * static_cast<std::size_t>(all.width);
    const std::size_t begin = row + static_cast<std::size_t>(part.data_window.x - all.x);
    const std::size_t end = begin + static_cast<std::size_t>(part.data_window.width);
    for (std::size_t p = begin; p < end; ++p)
      part.first_sample.push_back(part.first_sample.back() + samples.first_sample[p + 1] - samples.first_sample[p]);
    part.values.insert(part.values.end(), samples.record(samples.first_sample[begin]),
                       samples.record(samples.first_sample[end]));
  }
  return part;
}

double seconds_of(const SampleBuffer& samples, const Settings& settings, const Control& control) {
  const auto start = std::chrono::steady_clock::now();
  filter(samples, settings, control);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The preset, run as `settings` say.
Settings run_as(const Settings& settings, const Preset& preset) {
  Settings result = settings_of(preset);
  result.backend = settings.backend;
  result.device = settings.device;
  result.threads = settings.threads;
  result.max_memory = settings.max_memory;
  result.filter_features = settings.filter_features;
  result.estimate_error = settings.estimate_error;
  return result;
}

}  // namespace

std::vector<PresetInfo> presets() {
  std::vector<PresetInfo> result;
  for (const Preset& preset : all_presets) result.push_back({preset.name, preset.purpose});
  return result;
}

Settings preset_settings(const std::string& name) {
  std::vector<std::string> names;
  for (const Preset& preset : all_presets) {
    if (name == preset.name) return settings_of(preset);
    names.emplace_back(preset.name);
  }
  throw Error(ErrorKind::usage, fmt::format("preset '{}': one of {} is expected", name, fmt::join(names, ", ")));
}

std::vector<PresetTime> predict_presets(const SampleBuffer& samples, const Settings& settings, const Control& control) {
  const SampleBuffer part = middle_of(samples);
  const double pixels = static_cast<double>(samples.data_window.pixel_count()),
               tried = static_cast<double>(part.data_window.pixel_count());
  std::vector<PresetTime> times;
  for (const Preset& preset : all_presets) {
    const Settings trial = run_as(settings, preset);
    seconds_of(part, trial, control);  // compiles what is missing, and warms the caches
    times.push_back({preset.name, seconds_of(part, trial, control) * pixels / tried});
  }
  return times;
}

PresetTime best_within(const std::vector<PresetTime>& times, double seconds) {
  const auto fits = [&](const PresetTime& time) { return time.seconds <= seconds; };
  const auto best = std::find_if(times.rbegin(), times.rend(), fits);
  return best == times.rend() ? times.front() : *best;
}

}  // namespace rpf
