// What the page of rpf report measures on the samples: their plain mean, what is odd in them, where their noise is
// from.
#pragma once

#include <string>
#include <vector>

#include "cli/filter_input.h"
#include "cli/frame_page.h"
#include "rpf/explain.h"

namespace rpf::cli {

struct FrameNoise {
  Image mean;                    ///< R, G, B of the whole data window
  std::vector<InputNote> notes;  ///< about colors, film positions and random parameters
  std::optional<Explanation> explanation;
  std::string missing;  ///< why there is no explanation
  double seconds = 0;   ///< that attribution took
};

/// Shares of noise need no pass of the filter but the smallest one there is, whose picture is not looked at. Throws as
/// explain() and filter() do.
FrameNoise measure_noise(const FilterInput& input, const FramePageJob& job);

/// How much of the frame's noise each group of random parameters makes.
struct NoisePart {
  std::string group;
  double of_noise = 0;   ///< of the variance of the plain mean, over the frame: what the group alone decides
  double of_pixels = 0;  ///< where its share is the largest
};
std::vector<NoisePart> noise_parts(const Explanation& explanation);

}  // namespace rpf::cli
