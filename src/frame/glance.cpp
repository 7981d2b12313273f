#include "frame/glance.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>

#include "parallel/vectors.h"

namespace rpf {
namespace {

std::vector<std::size_t> all_columns(const SampleLayout& layout) {
  std::vector<std::size_t> columns(layout.size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  return columns;
}

std::int32_t bits_of(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// All bits where a value is missing, else none.
std::int32_t gap_of(float value) { return is_missing(value) ? ~0 : 0; }

}  // namespace

Glance::Glance(const SampleLayout& layout, const Columns& columns, const Conventions* conventions)
    : columns_(columns), conventions_(conventions), block_(all_columns(layout), layout.size()) {
  for (std::size_t c = 0; c < layout.size(); ++c) {
    const auto is_in = [&](const std::vector<std::size_t>& hit) {
      return std::find(hit.begin(), hit.end(), c) != hit.end();
    };
    if (!is_in(columns.first_hit) && !is_in(columns.second_hit)) always_.push_back(c);
  }
}

void Glance::look(const SampleBuffer& rows, std::size_t begin, std::size_t end, std::uint8_t* marks) {
  const Window& window = rows.data_window;
  const auto width = static_cast<std::size_t>(window.width);
  PixelCorners corners;
  std::size_t first = rows.first_sample[begin], count = 0;
  const auto flush = [&] {
    look_at_block(rows.record(first), count, corners, marks + first);
    first += count;
    count = 0;
  };
  for (std::size_t place = begin; place < end; ++place)
    for (std::uint32_t i = rows.first_sample[place]; i < rows.first_sample[place + 1]; ++i) {
      corners.x[count] = static_cast<float>(window.x + static_cast<int>(place % width));
      corners.y[count] = static_cast<float>(window.y + static_cast<int>(place / width));
      if (++count == block_records) flush();
    }
  if (count > 0) flush();
}

void Glance::look_at_block(const float* records, std::size_t count, const PixelCorners& corners, std::uint8_t* marks) {
  block_.take(records, count);
  BlockMask is_unclean = {}, is_odd = {};
  with_avx2([&] {
    find_unclean(is_unclean);
    std::fill(is_unclean + count, std::end(is_unclean), ~0);
    include_brightness(is_unclean);
  });
  if (conventions_ != nullptr) conventions_->look(block_, corners, is_odd);
  for (std::size_t i = 0; i < count; ++i)
    marks[i] = static_cast<std::uint8_t>((is_unclean[i] != 0 ? unclean : 0) | (is_odd[i] != 0 ? odd : 0));
}

/// A sample is clean that has no negative color or weight, has what every sample has, and all or nothing of each hit,
/// where what it lacks is marked as missing already: rays that hit nothing have no features.
void Glance::find_unclean(BlockMask& result) const {
  for (const std::size_t c : always_)
    for (std::size_t i = 0; i < block_records; ++i) result[i] |= gap_of(block_[c][i]);
  const auto find_negative = [&](const float* values) {
    for (std::size_t i = 0; i < block_records; ++i) result[i] |= values[i] < 0 ? ~0 : 0;
  };
  for (const std::size_t c : columns_.color) find_negative(block_[c]);
  if (columns_.weight) find_negative(block_[*columns_.weight]);
  BlockMask may_lack_first, may_lack_second;
  const float* hit = columns_.hit ? block_[*columns_.hit] : nullptr;
  for (std::size_t i = 0; i < block_records; ++i) may_lack_first[i] = hit == nullptr || hit[i] == 0 ? ~0 : 0;
  std::fill(std::begin(may_lack_second), std::end(may_lack_second), ~0);
  find_partial(columns_.first_hit, may_lack_first, result);
  find_partial(columns_.second_hit, may_lack_second, result);
}

/// `all`: whether a sample may lack all features of a hit; afterwards whether it may and does.
void Glance::find_partial(const std::vector<std::size_t>& hit, BlockMask& all, BlockMask& result) const {
  BlockMask any = {};
  for (const std::size_t c : hit) {
    const float* values = block_[c];
    for (std::size_t i = 0; i < block_records; ++i) {
      const std::int32_t gap = gap_of(values[i]);
      result[i] |= gap & (bits_of(values[i]) ^ bits_of(missing));
      any[i] |= gap;
      all[i] &= gap;
    }
  }
  for (std::size_t i = 0; i < block_records; ++i) result[i] |= any[i] & ~all[i];
}

void Glance::include_brightness(const BlockMask& left_out) {
  for (const std::size_t c : columns_.color)
    for (std::size_t i = 0; i < block_records; ++i) {
      const std::int32_t bits = left_out[i] != 0 ? 0 : bits_of(block_[c][i]);  // not negative
      brightest_[i] = std::max(brightest_[i], bits);
    }
}

float Glance::brightest() const {
  const std::int32_t bits = *std::max_element(std::begin(brightest_), std::end(brightest_));
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace rpf
