#include "study/experiment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rpf/error.h"

namespace rpf::study {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = {
      {"passes", "how wide, and how many passes: one of 3 to 17, two of 15 to 21 then 7 or 9, 35,17,7 against 7",
       plan_passes, tell_passes},
      {"features", "what normals and positions keep, alone and together: a column with a corner, a Menger sponge",
       plan_features, tell_features},
      {"effects", "4 samples a pixel, filtered, reference: lens, shutter, area light, gloss, all at once", plan_effects,
       tell_effects},
      {"methods", "Gaussian, bilateral and cross-bilateral filter against Random Parameter Filtering", plan_methods,
       tell_methods},
      {"textures", "the known weakness: a texture that looks like noise is taken for noise", plan_textures,
       tell_textures},
      {"spp", "how many samples the filter is worth: error against 1 to 64 samples a pixel", plan_spp, tell_spp},
      {"thesis-vs-paper", "the thesis's profile against the paper's: error, energy, high dynamic range, time",
       plan_thesis_vs_paper, tell_thesis_vs_paper},
      {"contemporaries",
       "the related work of 2008 to 2012 and Open Image Denoise beside ours, at 4, 16 and 64 samples; samples where "
       "the noise is",
       plan_contemporaries,
       tell_contemporaries,
       {160, 90, 1024}},  // paper at 64 samples takes 14 to 20 CPU milliseconds a pixel, most of the whole
  };
  return all;
}

const Experiment& find_experiment(const std::string& name) {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments()) {
    if (name == experiment.name) return experiment;
    names.emplace_back(experiment.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("study '{}': no such experiment; there are {}, and all", name, fmt::join(names, ", ")));
}

std::string treatment_of(const Run& run) { return run.options + (run.denoised ? ", then Open Image Denoise" : ""); }

bench::SweepFrame frame_of(const std::string& scene, const Extent& extent, int samples_per_pixel) {
  bench::SweepFrame frame;
  frame.name = frame.scene = scene;
  frame.width = extent.width;
  frame.height = extent.height;
  frame.samples_per_pixel = samples_per_pixel;
  frame.reference_samples = extent.reference_samples;
  return frame;
}

}  // namespace rpf::study
