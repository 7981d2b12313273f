// What the page of rpf report measures on the samples: their plain mean, what is odd in them, where their noise is
// from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/filter_input.h"
#include "cli/frame_page.h"
#include "report/viewer.h"

namespace rpf::cli {

/// How much of the frame's noise a group of random parameters makes.
struct NoisePart {
  std::string group;
  double of_noise = 0;   ///< of the variance of the plain mean, over the frame: what the group alone decides
  double of_pixels = 0;  ///< where its share is the largest
};

struct FrameNoise {
  Image mean;                                ///< R, G, B of the whole data window
  std::vector<InputNote> notes;              ///< about colors, film positions and random parameters
  std::optional<report::ViewerLayer> layer;  ///< where the noise comes from, pixel by pixel
  std::vector<NoisePart> parts;              ///< the same for the frame
  std::string missing;                       ///< why there is neither
  double seconds = 0;                        ///< that attribution took
};

/// Shares of noise need no pass of the filter but the smallest one there is, whose picture is not looked at. They are
/// left out where that takes more than the memory limit beside `held` bytes. Throws as explain() and filter() do.
FrameNoise measure_noise(const FilterInput& input, const FramePageJob& job, std::uint64_t held);

}  // namespace rpf::cli
