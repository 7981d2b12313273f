// The prepared frame: what a backend loads. Only what is modeled is in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/row_supply.h"

namespace rpf {

struct Frame {
  int width = 0, height = 0;
  std::size_t variables = 0;                ///< floats a record: color 3, position 2, random parameters, features
  std::vector<std::uint32_t> first_sample;  ///< [width * height + 1]
  std::vector<float> records;               ///< [sample][variables]; the color scaled; a missing value is NaN
  bool has_missing = false;                 ///< whether any value of the records is NaN
  std::vector<float> weights;               ///< [sample]: share in the pixel's mean; empty: all equal
  std::vector<float> others;                ///< of the learned estimator: [sample][carried - 3], beside the color
  RowSupply* supply = nullptr;              ///< of a learned estimate; null: all samples are in memory
  std::size_t first_record = 0;             ///< the sample that records, weights and others begin with

  const float* record(std::size_t sample) const { return records.data() + (sample - first_record) * variables; }
  float weight(std::size_t sample) const { return weights[sample - first_record]; }
  /// To be called before samples of rows are read: RowSupply::bring(). Returns the end of the rows that are there.
  int bring(int first, int end, bool again) const { return supply == nullptr ? end : supply->bring(first, end, again); }
  std::uint32_t samples(std::size_t pixel) const { return first_sample[pixel + 1] - first_sample[pixel]; }
  std::size_t sample_count() const { return first_sample.back(); }
};

}  // namespace rpf
