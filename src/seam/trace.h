// Every intermediate value of one pixel in one pass, so that two backends can be compared stage by stage.
#pragma once

#include <cstdint>
#include <vector>

#include "rpf_math.h"

namespace rpf {

/// What section 5 ends with. m features.
struct FilterWeights {
  kernel::rpf_color_weights color = {};
  std::vector<float> feature_fraction_random;  ///< [m] W_f,k^r
  std::vector<float> fraction_feature;         ///< [m] W_c^{f,k}
  std::vector<float> beta;                     ///< [m]
};

/// Variables are in the order of Variables (frame/variables.h); V is their number, m the number of features, N of
/// neighbors.
struct PixelTrace {
  int pass = 0;
  std::uint32_t pixel = 0;

  // Section 3. Means are relative to `shift`.
  std::vector<float> shift;                    ///< [V] subtracted before any sum
  std::vector<std::uint32_t> neighbors;        ///< [N] samples: the pixel's own, then accepted candidates in draw order
  std::vector<float> own_mean, own_deviation;  ///< [m] over the pixel's own samples
  std::vector<float> tolerance;                ///< [m] infinity: takes no part

  // Section 4, over N.
  std::vector<float> mean, inverse_deviation;  ///< [V] 0 where the variable counts as constant
  std::vector<float> normalized;               ///< [N][V]

  // Section 5.
  std::vector<std::uint8_t> bins;         ///< [N][V] bin + K
  std::vector<std::uint32_t> histograms;  ///< [pair][B][B], row: first variable; pairs as in mutual_information
  std::vector<float> mutual_information;  ///< colors x (position, random, features), then features x (position, random)
  FilterWeights filter_weights;

  // Section 6 and 7, of the pixel's own samples (s of them).
  std::vector<float> weights;   ///< [s][N]
  std::vector<float> filtered;  ///< [s][carried] before the outlier step
  std::vector<float> colors;    ///< [s][carried] at the end of the pass
};

}  // namespace rpf
