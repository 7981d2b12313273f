// Sections 6 and 7: the weighted means of a pixel's samples, and the outlier step after them.
#pragma once

#include <vector>

#include "cpu/neighborhood.h"
#include "cpu/statistics.h"

namespace rpf {

/// Scratch of the filter. Columns are padded to whole blocks of RPF_LANES neighbors.
struct FilterScratch {
  std::vector<float> coordinates;        ///< [active variable][padded N] values times their distance scale
  std::vector<float> colors;             ///< [carried][padded N] c' of the neighbors
  std::vector<float> smallest, largest;  ///< [carried] over the neighbors
  std::size_t active = 0, padded = 0;

  /// Makes room for `active` coordinates of so many neighbors, all 0.
  void start(std::uint32_t neighbors, std::size_t active);
};

/// Filters the own samples of a pixel: out[s][carried] from the colors c' [sample][carried] of the whole frame.
/// `weights`, if not null, receives w_ij: [s][N].
void filter_samples(const Plan& plan, const Neighborhood& n, std::uint32_t own, const FilterWeights& weights,
                    const std::vector<float>& colors, FilterScratch& scratch, float* out,
                    std::vector<float>* weights_out);

/// The last step of filter_samples(): the means with the weights that the scratch's coordinates give.
void average(std::size_t carried, const Neighborhood& n, std::uint32_t own, const std::vector<float>& colors,
             FilterScratch& scratch, float* out, std::vector<float>* weights_out);

/// Section 7, in place on the R, G, B of `samples` filtered samples [samples][carried].
void replace_outliers(float* filtered, std::uint32_t samples, std::size_t carried);

}  // namespace rpf
