#include "frame/sample_cleaner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rpf {
namespace {

/// A ray that hit nothing has no features, which is no fault: a sky.
bool is_miss(const float* record, const Columns& columns) {
  if (columns.hit) return record[*columns.hit] == 0;
  return std::all_of(columns.first_hit.begin(), columns.first_hit.end(),
                     [&](std::size_t c) { return is_missing(record[c]); });
}

bool weigh_nothing(const SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::size_t weight) {
  while (begin < end && samples.record(begin)[weight] == 0) ++begin;
  return begin == end;
}

}  // namespace

void move_samples(SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::uint32_t kept) {
  if (begin != kept) std::copy(samples.record(begin), samples.record(end), samples.record(kept));
}

std::uint32_t SampleCleaner::keep_samples(SampleBuffer& samples, std::uint32_t begin, std::uint32_t end,
                                          std::uint32_t kept, const Marks& marks, std::size_t pixel) {
  std::uint32_t count = 0;
  for (std::uint32_t sample = begin; sample < end; ++sample) {
    if ((marks[sample] & unclean) != 0 && !clean_usable(samples.record(sample), pixel)) continue;
    move_samples(samples, sample, sample + 1, kept + count++);
  }
  if (count > 0 || begin == end) return count;
  for (std::uint32_t sample = begin; sample < end; ++sample) {
    clean_lost(samples.record(sample), pixel);
    move_samples(samples, sample, sample + 1, kept + count++);
  }
  findings_.lost.add(pixel);
  return count;
}

void SampleCleaner::count_pixel(const SampleBuffer& samples, std::uint32_t begin, std::uint32_t end,
                                std::size_t pixel) {
  if (begin == end)
    findings_.empty.add(pixel);
  else if (columns_.weight && weigh_nothing(samples, begin, end, *columns_.weight))
    findings_.weightless.add(pixel);
}

bool SampleCleaner::clean_usable(float* record, std::size_t pixel) {
  take_infinite(record, pixel);
  if (!is_usable(record, pixel)) return false;
  clean(record, pixel);
  for (const std::size_t c : columns_.color) findings_.brightest = std::max(findings_.brightest, std::fabs(record[c]));
  return true;
}

/// What a sample without a usable color or weight keeps: it waits for the color of its pixel's neighbors.
void SampleCleaner::clean_lost(float* record, std::size_t pixel) {
  for (const std::size_t c : columns_.color) record[c] = 0;
  if (columns_.weight) record[*columns_.weight] = 1;
  clean(record, pixel);
}

/// Overflowed light is the largest that its type holds, not none.
void SampleCleaner::take_infinite(float* record, std::size_t pixel) {
  for (std::size_t c = 0; c < 3; ++c) {
    float& value = record[columns_.color[c]];
    if (columns_.largest[c] == 0 || !std::isinf(value) || value < 0) continue;
    findings_.infinite.add(pixel);
    value = columns_.largest[c];
  }
}

bool SampleCleaner::is_usable(const float* record, std::size_t pixel) {
  const auto is_finite = [&](std::size_t c) { return std::isfinite(record[c]); };
  if (!std::all_of(std::begin(columns_.color), std::end(columns_.color), is_finite)) {
    findings_.not_finite.add(pixel);
    return false;
  }
  if (!columns_.weight || (record[*columns_.weight] >= 0 && record[*columns_.weight] <= largest_value)) return true;
  findings_.no_weight.add(pixel);
  return false;
}

void SampleCleaner::clean(float* record, std::size_t pixel) {
  for (const std::size_t c : columns_.color) {
    if (!(record[c] < 0)) continue;
    findings_.negative.add(pixel);
    if (clamp_negative_) record[c] = 0;
  }
  if (columns_.alpha && is_missing(record[*columns_.alpha])) {
    findings_.alpha.add(pixel);
    record[*columns_.alpha] = 0;
  }
  mark_missing(record, pixel);
}

/// Marks what is missing, and counts the sample where it should not be: at a hit, or of what every sample has.
void SampleCleaner::mark_missing(float* record, std::size_t pixel) {
  const bool miss = is_miss(record, columns_);
  const auto has_any = [&](const std::vector<std::size_t>& hit) {
    return std::any_of(hit.begin(), hit.end(), [&](std::size_t c) { return !is_missing(record[c]); });
  };
  const bool second = !miss && has_any(columns_.second_hit);
  bool any = false;
  const auto mark = [&](const auto& of, bool counts) {
    for (const std::size_t c : of) {  // without branches, which no processor would guess
      const bool is = is_missing(record[c]), is_counted = is && counts;
      record[c] = is ? missing : record[c];
      findings_.missing_columns[c] = static_cast<char>(findings_.missing_columns[c] | static_cast<char>(is_counted));
      any |= is_counted;
    }
  };
  mark(columns_.film, true);
  mark(columns_.random, true);
  mark(columns_.first_hit, !miss);
  mark(columns_.second_hit, second);
  if (any) findings_.missing.add(pixel);
}

}  // namespace rpf
