// What cannot be used is left out or marked as missing before anything is computed (algorithm.md, section 1).
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "rpf/filter.h"
#include "rpf/samples.h"

namespace rpf {

/// What stands in the place of a value that is missing.
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// Where the slots that preparing a frame needs stand in a record.
struct Columns {
  std::size_t color[3] = {0, 0, 0}, film[2] = {0, 0};
  std::optional<std::size_t> alpha, weight, hit;
  std::vector<std::size_t> normal;                 ///< of the first hit: 3 columns, or none
  std::vector<std::size_t> position;               ///< of the first hit: the components there are
  std::vector<std::size_t> random;                 ///< random parameters
  std::vector<std::size_t> first_hit, second_hit;  ///< the features of each
  /// Of R, G, B: what an infinite value stands for; 0 where nothing does.
  float largest[3] = {0, 0, 0};
};

/// `clamp_infinite`: as in Settings.
Columns find_columns(const SampleBuffer& samples, bool clamp_infinite);

struct CleanReport {
  std::vector<InputNote> notes;  ///< what was found, and where first
  bool lacks_positions = false;  ///< whether a film position is missing
  float brightest = 0;           ///< the largest magnitude of R, G, B
};

/// Takes infinite radiance for the largest value of its type where Columns::largest says so, leaves out samples whose
/// color is not finite or whose weight is none, and marks unusable features, random parameters and film positions as
/// missing (NaN). A pixel that loses all its samples keeps them, in the color of its neighbors and with weight 1. The
/// buffer shrinks in place. Contradictions of the conventions are noted on the way, of the samples as they were.
CleanReport clean(SampleBuffer& samples, const Columns& columns, bool clamp_negative);

}  // namespace rpf
