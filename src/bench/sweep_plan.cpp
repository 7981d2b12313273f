#include "bench/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "rpf/density.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/rows.h"

namespace rpf::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("sweep plan \"{}\": {}", path, what));
}

std::string relative_to(const fs::path& folder, const std::string& file) {
  return file.empty() || fs::path(file).is_absolute() ? file : (folder / file).string();
}

SweepFrame read_frame(const std::string& plan, const Json& json, const std::string& scene_folder) {
  SweepFrame frame;
  frame.name = json.at("name").get<std::string>();
  frame.scene = json.value("scene", "");
  frame.settings = json.value("settings", frame.settings);
  if (frame.scene.empty()) {
    const fs::path folder = fs::absolute(plan).parent_path();
    frame.samples = relative_to(folder, json.at("samples").get<std::string>());
    frame.reference = relative_to(folder, json.value("reference", ""));
    return frame;
  }
  const std::string size = json.value("size", "240x135");
  if (std::sscanf(size.c_str(), "%dx%d", &frame.width, &frame.height) != 2)
    refuse(plan, fmt::format(R"(size "{}" of frame "{}": WIDTHxHEIGHT is expected)", size, frame.name));
  frame.samples_per_pixel = json.value("spp", 4);
  frame.reference_samples = json.value("reference_spp", 0);
  name_scene_files(frame, scene_folder);
  return frame;
}

SweepPlan parse(const std::string& path, const Json& json, const std::string& scene_folder) {
  SweepPlan plan;
  for (const Json& frame : json.at("frames")) plan.frames.push_back(read_frame(path, frame, scene_folder));
  for (const auto& [name, options] : json.at("settings").items())
    plan.settings.push_back({name, options.get<std::string>()});
  plan.rounds = json.value("rounds", plan.rounds);
  if (plan.rounds < 1) refuse(path, "rounds: a positive number is expected");
  return plan;
}

}  // namespace

SweepPlan read_sweep_plan(const std::string& path, const std::string& scene_folder) {
  std::error_code unknown;  // opening a pipe would wait for whoever writes to it
  if (fs::exists(path, unknown) && !fs::is_regular_file(path, unknown))
    refuse(path, "is a folder, a pipe or a device; name a regular file");
  std::ifstream file(path);
  if (!file) throw Error(ErrorKind::input, fmt::format("sweep plan \"{}\" cannot be read", path));
  try {
    return parse(path, Json::parse(file), scene_folder);
  } catch (const Json::exception& e) {
    refuse(path, std::string("not as docs/bench.md describes it: ") + e.what());
  }
}

void name_scene_files(SweepFrame& frame, const std::string& folder) {
  const std::string stem = fmt::format("{}-{}x{}", frame.scene, frame.width, frame.height);
  const auto file = [&](int samples, const char* kind) {
    return (fs::path(folder) / fmt::format("{}-{}spp.{}.exr", stem, samples, kind)).string();
  };
  const std::string how = std::string(frame.penumbra ? "-penumbra" : "") + (frame.lightfield ? "-lightfield" : "") +
                          (frame.adapted ? "-adapted" : "");
  frame.samples = file(frame.samples_per_pixel, "samples");
  frame.samples.insert(frame.samples.size() - std::string(".samples.exr").size(), how);
  if (frame.reference_samples > 0) frame.reference = file(frame.reference_samples, "reference");
}

SceneOptions scene_options(const SweepFrame& frame, int samples, SceneSampler sampler) {
  SceneOptions options;
  options.width = frame.width;
  options.height = frame.height;
  options.samples = samples;
  options.sampler = sampler;
  return options;
}

SceneOptions sample_options(const SweepFrame& frame) {
  SceneOptions options =
      scene_options(frame, frame.adapted ? adapted_from : frame.samples_per_pixel, SceneSampler::random);
  options.penumbra = frame.penumbra;
  options.lightfield = frame.lightfield;
  return options;
}

SampleBuffer render_samples(const SweepFrame& frame, const Control& control) {
  SceneOptions options = sample_options(frame);
  SampleBuffer samples = render_scene(frame.scene, options, control);
  options.samples = 1;
  for (int count = adapted_from, more = 0; frame.adapted && count < frame.samples_per_pixel; count += more) {
    more = std::min(count, frame.samples_per_pixel - count);
    options.density = sample_density(samples, more);
    ++options.seed;
    std::vector<SamplePart> parts;
    parts.push_back({"rounds before", std::move(samples)});
    parts.push_back({"round", render_scene(frame.scene, options, control)});
    samples = merge_samples(std::move(parts));
  }
  return samples;
}

void make_reference(const SweepFrame& frame, const Control& control) {
  if (frame.reference.empty() || fs::exists(frame.reference)) return;
  fs::create_directories(fs::path(frame.reference).parent_path());
  const SceneOptions options = scene_options(frame, frame.reference_samples, SceneSampler::sobol);
  write_image(frame.reference, render_reference(frame.scene, options, control));
}

void make_scene_files(const SweepFrame& frame, const Control& control) {
  if (frame.scene.empty()) return;
  fs::create_directories(fs::path(frame.samples).parent_path());
  if (!fs::exists(frame.samples))  // by rows: writing asks the control between them
    write_sample_rows(frame.samples, *open_scene_rows(frame.scene, sample_options(frame)), {}, control);
  make_reference(frame, control);
}

bool applies(const SweepSetting& setting, const SweepFrame& frame) {
  return frame.settings.empty() ||
         std::find(frame.settings.begin(), frame.settings.end(), setting.name) != frame.settings.end();
}

std::string key_of(const SweepFrame& frame, const SweepSetting& setting, int round) {
  return fmt::format("{} | {} | {}", fs::path(frame.samples).filename().string(), setting.options, round);
}

}  // namespace rpf::bench
