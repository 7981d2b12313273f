// Some records column by column: what is asked of every sample is then asked of many at once, in vectors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rpf {

/// Records that are looked at, or made, at once: all their values stay in the first cache.
constexpr std::size_t block_records = 64;

/// Answers for the records of a block: 0 or not. As wide as the values that they are about, or no compiler would use
/// vectors.
using BlockMask = std::int32_t[block_records];

class ColumnBlock {
 public:
  /// Of these columns of records of `stride` values, at least 4.
  ColumnBlock(const std::vector<std::size_t>& columns, std::size_t stride);

  /// Takes up to block_records records that lie one after the other.
  void take(const float* records, std::size_t count);

  std::size_t count() const { return count_; }
  /// block_records values, of which those from count() on are of no record.
  const float* operator[](std::size_t column) const { return values_.data() + column * block_records; }

 private:
  std::vector<std::size_t> fours_;  ///< the first of four columns that are taken
  std::size_t stride_, count_ = 0;
  std::vector<float> values_, few_;  ///< [column][record]; [record][column]: a block that is not full
};

/// Writes `count` records, up to block_records, one after the other: of the values of each of these columns in turn.
void write_records(const std::vector<const float*>& columns, std::size_t count, float* to);

}  // namespace rpf
