// Which samples need a closer look: found many at a time, in vectors. In most frames hardly any does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/clean.h"
#include "frame/column_block.h"
#include "frame/conventions.h"
#include "rpf/samples.h"

namespace rpf {

class Glance {
 public:
  /// `conventions`: none where nobody wants to know. What it is given outlives this.
  Glance(const SampleLayout& layout, const Columns& columns, const Conventions* conventions);

  /// Looks at the samples of the pixels begin .. end - 1 of these rows. `marks`: of all samples of the rows.
  void look(const SampleBuffer& rows, std::size_t begin, std::size_t end, std::uint8_t* marks);

  /// The largest magnitude of R, G, B of all samples so far that are clean.
  float brightest() const;

 private:
  void look_at_block(const float* records, std::size_t count, const PixelCorners& corners, std::uint8_t* marks);
  void find_unclean(BlockMask& result) const;
  void find_partial(const std::vector<std::size_t>& hit, BlockMask& all, BlockMask& result) const;
  void include_brightness(const BlockMask& left_out);

  const Columns& columns_;
  const Conventions* conventions_;
  std::vector<std::size_t> always_;  ///< columns that no sample lacks
  ColumnBlock block_;
  std::int32_t brightest_[block_records] = {};  ///< [place in a block] bits: they are in the order of the values
};

}  // namespace rpf
