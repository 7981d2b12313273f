// The prepared frame: what a backend loads. Only what is modeled is in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rpf {

struct Frame {
  int width = 0, height = 0;
  std::size_t variables = 0;                ///< floats a record: color 3, position 2, random parameters, features
  std::vector<std::uint32_t> first_sample;  ///< [width * height + 1]
  std::vector<float> records;               ///< [sample][variables]; the color scaled; a missing value is NaN
  bool has_missing = false;                 ///< whether any value of the records is NaN
  std::vector<float> weights;               ///< [sample]: share in the pixel's mean; empty: all equal

  const float* record(std::size_t sample) const { return records.data() + sample * variables; }
  std::uint32_t samples(std::size_t pixel) const { return first_sample[pixel + 1] - first_sample[pixel]; }
  std::size_t sample_count() const { return first_sample.back(); }
};

}  // namespace rpf
