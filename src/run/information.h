// How much a frame's random parameters and features tell about its colors, measured before anything is filtered.
#pragma once

#include <string>
#include <vector>

#include "frame/prepare.h"

namespace rpf {

/// What a channel tells about one kind of partners, at the measured pixels where both vary. A reading is the mutual
/// information with the partners, summed, times twice the number of samples: twice the logarithm of a likelihood ratio.
struct Evidence {
  std::vector<double> excess;  ///< [pixel] reading less that of the same samples, the channel shuffled among them
  std::vector<double> chance;  ///< [pixel] the same for one shuffle less another: what excess is where there is nothing

  /// Whether there are pixels enough to tell.
  bool is_enough() const;
  /// Whether excess is more than chance: over all pixels, or at the few pixels where it is largest.
  bool is_information() const;
};

struct ChannelEvidence {
  std::string name;
  Evidence color, features;  ///< features: of random parameters only

  /// Whether it is shown to tell nothing: about colors, and of a random parameter about features.
  bool is_uninformative() const { return color.is_enough() && !color.is_information() && !features.is_information(); }
};

/// One entry for each random parameter and feature, in the order of Variables. Looks at some hundred pixels of the
/// whole frame, at most, and at the samples around them; the crop, the backend and the passes do not matter. `prepared`
/// is as before afterwards.
std::vector<ChannelEvidence> measure_information(PreparedFrame& prepared, const Settings& settings);

}  // namespace rpf
