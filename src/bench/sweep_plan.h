// What a sweep measures: every setting on every frame, in rounds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/scene.h"

namespace rpf::bench {

/// Samples a pixel of the first round of SweepFrame::adapted.
constexpr int adapted_from = 4;

/// A frame to filter: files, or a scene of rpf scene that is rendered where its files are not there yet.
struct SweepFrame {
  std::string name;
  std::string samples, reference;  ///< paths; the reference may be empty
  std::string scene;               ///< empty: the files have to be there
  int width = 240, height = 135, samples_per_pixel = 4;
  int reference_samples = 0;          ///< a pixel; 0: no reference
  bool penumbra = false;              ///< of a scene: rendered with SceneOptions::penumbra
  bool lightfield = false;            ///< likewise, with SceneOptions::lightfield
  bool adapted = false;               ///< of a scene: rounds as rpf adapt has them, from 4 samples a pixel on
  std::vector<std::string> settings;  ///< names of those to run on it; empty: all
};

struct SweepSetting {
  std::string name;
  std::string options;  ///< as on the command line of `rpf INPUT -o OUTPUT`
};

struct SweepPlan {
  std::vector<SweepFrame> frames;
  std::vector<SweepSetting> settings;
  int rounds = 5;
};

/// Reads a plan (docs/bench.md). Paths in it are relative to its folder; files of scenes go to `scene_folder`.
/// Throws Error(input) that names what is wrong.
SweepPlan read_sweep_plan(const std::string& path, const std::string& scene_folder);

/// Names the files of a frame that is a scene: they say how they were made.
void name_scene_files(SweepFrame& frame, const std::string& folder);

/// How a scene is rendered: its samples by SceneSampler::random, its reference by SceneSampler::sobol.
SceneOptions scene_options(const SweepFrame& frame, int samples, SceneSampler sampler);

/// How its samples are rendered, those of the first round where the frame is adapted.
SceneOptions sample_options(const SweepFrame& frame);

/// Renders the samples of a scene. Throws as render_scene() does.
SampleBuffer render_samples(const SweepFrame& frame, const Control& control);

/// Renders the reference of a scene where its file is not there. Throws as render_reference() and write_image() do.
void make_reference(const SweepFrame& frame, const Control& control);

/// Renders the files of a scene that is not adapted where they are not there. Throws as render_scene() and the writers
/// do.
void make_scene_files(const SweepFrame& frame, const Control& control);

/// Whether the plan wants this setting on this frame.
bool applies(const SweepSetting& setting, const SweepFrame& frame);

/// What tells one measurement from all others: the samples' file name, the options and the round.
std::string key_of(const SweepFrame& frame, const SweepSetting& setting, int round);

}  // namespace rpf::bench
