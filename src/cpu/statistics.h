// Sections 4 and 5: normalization, mutual information, and the weights alpha and beta that follow from them.
#pragma once

#include <cstdint>
#include <vector>

#include "cpu/neighborhood.h"
#include "seam/trace.h"

namespace rpf {

/// Section 4. Over the neighborhood: V variables.
struct Normalization {
  std::vector<float> mean, inverse_deviation;  ///< [V] mean relative to the shift; 0 for a constant variable
  std::vector<float> largest;                  ///< [V] largest magnitude of the unshifted values
  std::vector<std::uint32_t> count;            ///< [V] values that are not missing
  LaneSums sums;
};

/// Normalizes the rows of the neighborhood in place.
void normalize(Neighborhood& n, Normalization& out);

/// Joint histograms of the pairs that the weights need, and the mutual information of each. Pairs: every color with
/// every other variable but the colors, then every feature with every position and random parameter. B bins.
struct Dependencies {
  std::vector<std::uint8_t> bins;         ///< [N][V] bin + K
  std::vector<std::uint32_t> histograms;  ///< [pair][B][B]
  std::vector<std::uint32_t> marginals;   ///< [V][B]
  std::vector<float> information;         ///< [pair] nats
};

/// Section 5, first half.
void measure_dependencies(const Plan& plan, int pass, const Neighborhood& n, Dependencies& out);

/// Section 5, second half.
void compute_weights(const Plan& plan, int pass, const Dependencies& dependencies, FilterWeights& out);

}  // namespace rpf
