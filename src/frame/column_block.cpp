#include "frame/column_block.h"

#include <algorithm>
#include <cstring>

namespace rpf {
namespace {

using Four = float __attribute__((vector_size(16)));

Four four_at(const float* from) {
  Four values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

/// Rows that begin at these places to columns at those.
void transpose(const float* const (&from)[4], float* const (&to)[4]) {
  const Four a = four_at(from[0]), b = four_at(from[1]), c = four_at(from[2]), d = four_at(from[3]);
  const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const Four columns[4] = {
      __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5), __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
      __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5), __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
  for (std::size_t k = 0; k < 4; ++k) std::memcpy(to[k], &columns[k], sizeof columns[k]);
}

}  // namespace

ColumnBlock::ColumnBlock(const std::vector<std::size_t>& columns, std::size_t stride)
    : stride_(stride), values_(stride * block_records), few_(stride * block_records) {
  for (const std::size_t c : columns) fours_.push_back(std::min(c / 4 * 4, stride - 4));
  std::sort(fours_.begin(), fours_.end());
  fours_.erase(std::unique(fours_.begin(), fours_.end()), fours_.end());
}

void ColumnBlock::take(const float* records, std::size_t count) {
  count_ = count;
  if (count < block_records) records = std::copy_n(records, count * stride_, few_.data()) - count * stride_;
  for (std::size_t i = 0; i < block_records; i += 4) {
    const float* record = records + i * stride_;
    // A block ahead, or behind the last record: all lines are read, but not in an order that processors foresee.
    for (std::size_t k = 0; k < 4 * stride_; k += 16) __builtin_prefetch(record + block_records * stride_ + k);
    for (const std::size_t c : fours_) {
      float* to = values_.data() + c * block_records + i;
      transpose({record + c, record + stride_ + c, record + 2 * stride_ + c, record + 3 * stride_ + c},
                {to, to + block_records, to + 2 * block_records, to + 3 * block_records});
    }
  }
}

void write_records(const std::vector<const float*>& columns, std::size_t count, float* to) {
  const std::size_t width = columns.size(), records_by_four = count / 4 * 4, columns_by_four = width / 4 * 4;
  for (std::size_t i = 0; i < records_by_four; i += 4)
    for (std::size_t c = 0; c < columns_by_four; c += 4) {
      float* record = to + i * width + c;
      transpose({columns[c] + i, columns[c + 1] + i, columns[c + 2] + i, columns[c + 3] + i},
                {record, record + width, record + 2 * width, record + 3 * width});
    }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = i < records_by_four ? columns_by_four : 0; c < width; ++c) to[i * width + c] = columns[c][i];
}

}  // namespace rpf
