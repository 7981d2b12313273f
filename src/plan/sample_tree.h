// Samples in the space of film, lens and time, cut in halves again and again (algorithm.md, (12.2)).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nearest.h"

namespace rpf {

/// Coordinates of (12.1), in pixels.
using ColumnPlace = std::array<double, RPF_DIMENSIONS>;

/// As kernel::rpf_sample_tree has it, but for the metric.
struct SampleTree {
  std::uint32_t leaves = 0;            ///< a power of two; 0: there are no samples
  std::vector<std::uint32_t> axis;     ///< [node]
  std::vector<float> split;            ///< [node]
  std::vector<std::uint32_t> first;    ///< [leaf + 1]
  std::vector<float> places;           ///< [sample by leaf][RPF_DIMENSIONS]
  std::vector<std::uint32_t> samples;  ///< [sample by leaf] its number

  const float* place(std::size_t i) const { return places.data() + i * RPF_DIMENSIONS; }
};

/// How many leaves a tree of so many samples has.
std::uint32_t leaves_for(std::uint64_t samples);

/// Of places [sample][RPF_DIMENSIONS]; a sample whose place is not finite is left out.
SampleTree make_sample_tree(const std::vector<float>& places);

/// The samples that are nearest to a place, at most so many, as they stand in the tree; in any order, but always the
/// same one. Of samples that are equally near those of lower numbers.
std::vector<std::uint32_t> nearest_samples(const SampleTree& tree, const ColumnPlace& place, std::size_t count);

}  // namespace rpf
