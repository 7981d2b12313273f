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

/// Records of `width` values in the place of the buffer's own where there is room; its values are gone afterwards.
/// `make(from, to)` writes one. Longer records are made from the last on, so that none overwrites one that is still to
/// be read.
template <typename Make>
std::vector<float> repack(SampleBuffer& samples, std::size_t width, const Make& make) {
  const std::size_t count = samples.sample_count(), from = samples.layout.size();
  std::vector<float> elsewhere;
  const bool in_place = count * width <= samples.values.capacity();
  std::vector<float>& target = in_place ? samples.values : elsewhere;
  target.resize(count * std::max(in_place ? from : 0, width));
  std::vector<float> record(from);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = width > from ? count - 1 - n : n;
    std::copy_n(samples.values.data() + i * from, from, record.begin());
    make(static_cast<const float*>(record.data()), target.data() + i * width);
  }
  target.resize(count * width);
  release_tail(target);
  return std::move(target);
}

}  // namespace rpf
