// Records of another width in the place of those that were read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "rpf/samples.h"

namespace rpf {

/// Gives the memory behind the last element back: shrink_to_fit() would copy, and need both at once.
void release_tail(std::vector<float>& values);

/// Records that are made at once: their values, one after the other of each variable, stay in the first cache.
constexpr std::size_t block_records = 64;

/// Records of `width` values in the place of the buffer's own where there is room; its values are gone afterwards.
/// `make(from, to, count)` writes up to block_records of them. Longer records are made from the last on, so that none
/// overwrites one that is still to be read.
template <typename Make>
std::vector<float> repack(SampleBuffer& samples, std::size_t width, const Make& make) {
  const std::size_t count = samples.sample_count(), from = samples.layout.size();
  std::vector<float> elsewhere;
  const bool in_place = count * width <= samples.values.capacity();
  std::vector<float>& target = in_place ? samples.values : elsewhere;
  target.resize(count * std::max(in_place ? from : 0, width));
  std::vector<float> copy(block_records * from);
  const std::size_t blocks = (count + block_records - 1) / block_records;
  for (std::size_t n = 0; n < blocks; ++n) {
    const std::size_t first = (width > from ? blocks - 1 - n : n) * block_records;
    const std::size_t number = std::min(block_records, count - first);
    std::copy_n(samples.values.data() + first * from, number * from, copy.begin());
    make(static_cast<const float*>(copy.data()), target.data() + first * width, number);
  }
  target.resize(count * width);
  release_tail(target);
  return std::move(target);
}

}  // namespace rpf
