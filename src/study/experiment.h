// What an experiment is: a question, the runs that answer it, and how the answer is told.
#pragma once

#include <string>
#include <vector>

#include "bench/sweep_plan.h"

namespace rpf::study {

/// What all frames of a study share.
struct Extent {
  int width = 320, height = 180;
  int reference_samples = 512;  ///< a pixel
  bool quick = false;           ///< fewer points
};

/// A frame filtered with one setting.
struct Run {
  std::string label;        ///< tells it from the others on its frame
  bench::SweepFrame frame;  ///< a scene; its files have no folder yet
  std::string options;      ///< as on the command line of `rpf INPUT -o OUTPUT`
  bool denoised = false;    ///< by Open Image Denoise after that, which then makes the plain mean
};

/// What was done to the samples, as tables and results have it: the options, and the denoiser.
std::string treatment_of(const Run& run);

class Findings;
class Story;

struct Experiment {
  const char* name;
  const char* question;  ///< one line
  std::vector<Run> (*plan)(const Extent& extent);
  void (*tell)(const Findings& findings, Story& story);
  Extent full = {};  ///< where neither a size nor the quick form is asked for
};

/// All there are, in the order of docs/study.md.
const std::vector<Experiment>& experiments();

/// Throws Error(usage) for an unknown name, naming those there are.
const Experiment& find_experiment(const std::string& name);

/// A scene at the extent of the study.
bench::SweepFrame frame_of(const std::string& scene, const Extent& extent, int samples_per_pixel = 4);

/// The plain mean of the samples.
inline const char* const plain_mean = "--boxes none";

// The experiments, each in a file of its name.
std::vector<Run> plan_passes(const Extent& extent);
void tell_passes(const Findings& findings, Story& story);
std::vector<Run> plan_features(const Extent& extent);
void tell_features(const Findings& findings, Story& story);
std::vector<Run> plan_effects(const Extent& extent);
void tell_effects(const Findings& findings, Story& story);
std::vector<Run> plan_methods(const Extent& extent);
void tell_methods(const Findings& findings, Story& story);
std::vector<Run> plan_textures(const Extent& extent);
void tell_textures(const Findings& findings, Story& story);
std::vector<Run> plan_spp(const Extent& extent);
void tell_spp(const Findings& findings, Story& story);
std::vector<Run> plan_thesis_vs_paper(const Extent& extent);
void tell_thesis_vs_paper(const Findings& findings, Story& story);
std::vector<Run> plan_contemporaries(const Extent& extent);
void tell_contemporaries(const Findings& findings, Story& story);

}  // namespace rpf::study
