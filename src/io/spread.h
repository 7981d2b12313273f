// Values that lie channel by channel in a file become records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rpf::io {

/// A little-endian number, as OpenEXR and raw sample files store them.
std::uint32_t word_at(const std::uint8_t* bytes);

/// Where the values of a channel stand, and where they go.
struct SpreadTarget {
  std::size_t begin = 0;  ///< bytes a sample of the channels before it
  bool half_float = false;
  std::size_t column = 0;  ///< of the record
};

/// Spreads the values of `samples` samples, for each channel one after the other, over their records of `stride`
/// values; some records at a time, which stay in the cache meanwhile. Bits of floats are kept, also of a NaN.
void spread(const std::uint8_t* values, const std::vector<SpreadTarget>& targets, std::size_t samples, float* records,
            std::size_t stride);

}  // namespace rpf::io
