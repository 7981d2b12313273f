#include "frame/clean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#include "frame/lost_pixels.h"
#include "frame/variables.h"

namespace rpf {
namespace {

/// Larger feature values count as missing: their squares would not survive a sum, and renderers write such values for
/// "no hit". Nor would sums of larger weights or alphas.
constexpr float largest_value = 1e15F;
constexpr float largest_half = 65504;

std::vector<std::size_t> all_of(const SampleLayout& layout, std::initializer_list<const char*> slots) {
  std::vector<std::size_t> columns;
  for (const char* slot : slots)
    if (const auto column = layout.find(slot)) columns.push_back(*column);
  return columns.size() == slots.size() ? columns : std::vector<std::size_t>{};
}

/// Overflowed light is the largest that its type holds, not none.
void take_infinite(float* record, const Columns& columns, CleanFindings& findings, std::size_t pixel) {
  for (std::size_t c = 0; c < 3; ++c) {
    float& value = record[columns.color[c]];
    if (columns.largest[c] == 0 || !std::isinf(value) || value < 0) continue;
    findings.infinite.add(pixel);
    value = columns.largest[c];
  }
}

bool is_usable(const float* record, const Columns& columns, CleanFindings& findings, std::size_t pixel) {
  const auto is_finite = [&](std::size_t c) { return std::isfinite(record[c]); };
  if (!std::all_of(std::begin(columns.color), std::end(columns.color), is_finite)) {
    findings.not_finite.add(pixel);
    return false;
  }
  if (!columns.weight || (record[*columns.weight] >= 0 && record[*columns.weight] <= largest_value)) return true;
  findings.no_weight.add(pixel);
  return false;
}

std::int32_t bits_of(const float& value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// What a record lacks, of its hits and otherwise.
struct Gaps {
  bool others = false;  ///< of what every sample has, or values that have to be marked as missing yet
  bool any_first = false, all_first = false, any_second = false, all_second = false;
};

/// Compares bits, all of them, in vectors.
Gaps gaps_of(const float* record, std::size_t size, const Columns& columns) {
  const std::int32_t limit = bits_of(largest_value), marked = bits_of(missing);
  std::int32_t others = 0, any_first = 0, all_first = ~0, any_second = 0, all_second = ~0;
  for (std::size_t c = 0; c < size; ++c) {
    const std::int32_t bits = bits_of(record[c]), first = columns.is_first[c], second = columns.is_second[c];
    const std::int32_t gap = (bits & std::numeric_limits<std::int32_t>::max()) > limit ? ~0 : 0;
    others |= gap & (~(first | second) | (bits ^ marked));
    any_first |= gap & first;
    all_first &= gap | ~first;
    any_second |= gap & second;
    all_second &= gap | ~second;
  }
  return {others != 0, any_first != 0, all_first != 0, any_second != 0, all_second != 0};
}

/// Whether nothing in a record needs a closer look; most are like that. A ray that hit nothing, once or twice, has no
/// features, and they are marked as missing already.
bool is_plain(const float* record, std::size_t size, const Columns& columns) {
  const auto is_negative = [&](std::size_t c) { return record[c] < 0; };
  if (std::any_of(std::begin(columns.color), std::end(columns.color), is_negative)) return false;
  if (columns.weight && is_negative(*columns.weight)) return false;
  const Gaps gaps = gaps_of(record, size, columns);
  const bool is_miss = gaps.all_first && (!columns.hit || record[*columns.hit] == 0);
  return !gaps.others && (!gaps.any_first || is_miss) && (!gaps.any_second || gaps.all_second);
}

bool is_missing(float value) { return !(std::fabs(value) <= largest_value); }

/// A ray that hit nothing has no features, which is no fault: a sky.
bool is_miss(const float* record, const Columns& columns) {
  if (columns.hit) return record[*columns.hit] == 0;
  return std::all_of(columns.first_hit.begin(), columns.first_hit.end(),
                     [&](std::size_t c) { return is_missing(record[c]); });
}

/// Marks what is missing, and counts the sample where it should not be: at a hit, or of what every sample has.
void mark_missing(float* record, const Columns& columns, CleanFindings& findings, std::size_t pixel) {
  const bool miss = is_miss(record, columns);
  const auto has_any = [&](const std::vector<std::size_t>& hit) {
    return std::any_of(hit.begin(), hit.end(), [&](std::size_t c) { return !is_missing(record[c]); });
  };
  const bool second = !miss && has_any(columns.second_hit);
  bool any = false;
  const auto mark = [&](const auto& of, bool counts) {
    for (const std::size_t c : of) {  // without branches, which no processor would guess
      const bool is = is_missing(record[c]), is_counted = is && counts;
      record[c] = is ? missing : record[c];
      findings.missing_columns[c] = static_cast<char>(findings.missing_columns[c] | static_cast<char>(is_counted));
      any |= is_counted;
    }
  };
  mark(columns.film, true);
  mark(columns.random, true);
  mark(columns.first_hit, !miss);
  mark(columns.second_hit, second);
  if (any) findings.missing.add(pixel);
}

void clean_record(float* record, const Columns& columns, bool clamp_negative, CleanFindings& findings,
                  std::size_t pixel) {
  for (const std::size_t c : columns.color) {
    if (!(record[c] < 0)) continue;
    findings.negative.add(pixel);
    if (clamp_negative) record[c] = 0;
  }
  if (columns.alpha && !(std::fabs(record[*columns.alpha]) <= largest_value)) {
    findings.alpha.add(pixel);
    record[*columns.alpha] = 0;
  }
  mark_missing(record, columns, findings, pixel);
}

std::string list_of(const std::vector<char>& columns, const SampleLayout& layout) {
  constexpr std::size_t listed = 12;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c] != 0) names.push_back(layout.slots[c]);
  const std::string rest = names.size() > listed ? fmt::format(" and {} more", names.size() - listed) : "";
  names.resize(std::min(names.size(), listed));
  return fmt::format("{}{}", fmt::join(names, " "), rest);
}

std::vector<InputNote> notes_of(const CleanFindings& findings, const SampleBuffer& samples, bool clamp_negative) {
  std::vector<InputNote> notes;
  const auto tell = [&](const Tally& tally, const std::string& what) { tally.tell(what, samples.data_window, notes); };
  tell(findings.infinite, "infinite radiance values, taken for the largest of their type");
  tell(findings.not_finite, "samples left out: R, G or B not finite");
  tell(findings.no_weight, "samples left out: weight not a number from 0 to 1e15");
  tell(findings.lost, "pixels that lost all their samples, filled from their neighbors");
  tell(findings.empty, "pixels without samples, black");
  tell(findings.negative, clamp_negative ? "negative radiance values, set to 0" : "negative radiance values, kept");
  tell(findings.alpha, "values of alpha not finite or beyond 1e15, set to 0");
  tell(findings.missing, "samples with missing values of " + list_of(findings.missing_columns, samples.layout));
  return notes;
}

/// What a sample without a usable color or weight keeps: it waits for the color of its pixel's neighbors.
void clean_lost_record(float* record, const Columns& columns, bool clamp_negative, CleanFindings& findings,
                       std::size_t pixel) {
  for (const std::size_t c : columns.color) record[c] = 0;
  if (columns.weight) record[*columns.weight] = 1;
  clean_record(record, columns, clamp_negative, findings, pixel);
}

/// Moves the samples of a pixel that can be used to `kept`, all of them where none can. Returns how many.
std::uint32_t keep_samples(SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::uint32_t kept,
                           const Columns& columns, bool clamp_negative, CleanFindings& findings, std::size_t pixel) {
  const std::size_t stride = samples.layout.size();
  std::uint32_t count = 0;
  for (std::uint32_t sample = begin; sample < end; ++sample) {
    float* record = samples.record(sample);
    if (!is_plain(record, stride, columns)) {
      take_infinite(record, columns, findings, pixel);
      if (!is_usable(record, columns, findings, pixel)) continue;
      clean_record(record, columns, clamp_negative, findings, pixel);
    }
    for (const std::size_t c : columns.color) findings.brightest = std::max(findings.brightest, std::fabs(record[c]));
    if (sample != kept + count) std::copy(record, record + stride, samples.record(kept + count));
    ++count;
  }
  if (count > 0 || begin == end) return count;
  for (std::uint32_t sample = begin; sample < end; ++sample) {
    float* record = samples.record(sample);
    clean_lost_record(record, columns, clamp_negative, findings, pixel);
    if (sample != kept + count) std::copy(record, record + stride, samples.record(kept + count));
    ++count;
  }
  findings.lost.add(pixel);
  return count;
}

/// Cleans all pixels; `before` and `after` are told the place of each, and `after` which samples it keeps and whether
/// it had to lose them all.
template <class Before, class After>
void clean_rows(SampleBuffer& rows, std::size_t first, const Columns& columns, bool clamp_negative,
                CleanFindings& findings, const Before& before, const After& after) {
  std::uint32_t kept = 0;
  for (std::size_t place = 0; place + 1 < rows.first_sample.size(); ++place) {
    before(place);
    const std::uint32_t begin = std::exchange(rows.first_sample[place], kept), end = rows.first_sample[place + 1];
    const std::uint64_t lost_before = findings.lost.count;
    kept += keep_samples(rows, begin, end, kept, columns, clamp_negative, findings, first + place);
    if (begin == end) findings.empty.add(first + place);
    after(place, rows.first_sample[place], kept, findings.lost.count > lost_before);
  }
  rows.first_sample.back() = kept;
  rows.values.resize(kept * rows.layout.size());
}

}  // namespace

Columns find_columns(const SampleBuffer& samples, bool clamp_infinite) {
  const SampleLayout& layout = samples.layout;
  Columns c;
  const auto color = all_of(layout, {"R", "G", "B"});
  const auto film = all_of(layout, {"film.X", "film.Y"});
  std::copy(color.begin(), color.end(), c.color);
  std::copy(film.begin(), film.end(), c.film);
  for (std::size_t i = 0; i < 3; ++i)
    c.largest[i] = samples.is_half(layout.slots[c.color[i]]) ? largest_half
                   : clamp_infinite                          ? std::numeric_limits<float>::max()
                                                             : 0;
  c.alpha = layout.find("A");
  c.weight = layout.find("weight");
  c.hit = layout.find("feature.hit");
  c.normal = all_of(layout, {"feature.N.X", "feature.N.Y", "feature.N.Z"});
  c.is_first.resize(layout.size());
  c.is_second.resize(layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (is_random_slot(layout.slots[i])) c.random.push_back(i);
    if (!is_feature_slot(layout.slots[i])) continue;
    const std::string group = group_of(layout.slots[i]);
    if (group == "P") c.position.push_back(i);
    (is_second_hit(group) ? c.second_hit : c.first_hit).push_back(i);
    (is_second_hit(group) ? c.is_second : c.is_first)[i] = ~0;
  }
  return c;
}

std::size_t first_pixel(const Window& rows, const Window& data_window) {
  return static_cast<std::size_t>(rows.y - data_window.y) * static_cast<std::size_t>(data_window.width);
}

Cleaning::Cleaning(const SampleBuffer& frame, const Columns& columns, bool clamp_negative)
    : frame_(frame),
      columns_(columns),
      clamp_negative_(clamp_negative),
      conventions_(frame),
      colors_(frame.data_window.pixel_count()) {
  findings_.missing_columns.resize(frame.layout.size());
}

void Cleaning::add(SampleBuffer& rows, const Seen& seen) {
  const std::size_t first = first_pixel(rows.data_window, frame_.data_window);
  clean_rows(
      rows, first, columns_, clamp_negative_, findings_,
      [&](std::size_t place) { conventions_.add(rows, place, first + place); },
      [&](std::size_t place, std::uint32_t begin, std::uint32_t end, bool lost) {
        most_samples_ = std::max(most_samples_, end - begin);
        if (lost)
          lost_.push_back({first + place, end - begin, {}});
        else
          colors_[first + place] = color_of_samples(rows, columns_, begin, end);
        if (seen) seen(place, begin, end);
      });
}

bool Cleaning::lacks_positions() const {
  return std::any_of(std::begin(columns_.film), std::end(columns_.film),
                     [&](std::size_t c) { return findings_.missing_columns[c] != 0; });
}

CleanReport Cleaning::report() {
  CleanReport report;
  report.lost = std::move(lost_);
  report.has_color = report.lost.empty() || find_lost_colors(frame_.data_window, colors_, report.lost);
  if (!report.has_color) {  // of the whole frame
    report.lost.clear();
    findings_.empty = std::exchange(findings_.lost, {});
    most_samples_ = 0;
  }
  report.most_samples = most_samples_;
  report.brightest = findings_.brightest;
  report.lacks_positions = lacks_positions();
  report.notes = conventions_.notes(frame_.data_window);
  std::vector<InputNote> found = notes_of(findings_, frame_, clamp_negative_);
  std::move(found.begin(), found.end(), std::back_inserter(report.notes));
  return report;
}

void clean_again(SampleBuffer& rows, const Columns& columns, bool clamp_negative) {
  CleanFindings found_before;
  found_before.missing_columns.resize(rows.layout.size());
  clean_rows(
      rows, 0, columns, clamp_negative, found_before, [](std::size_t /*place*/) {},
      [](std::size_t /*place*/, std::uint32_t /*begin*/, std::uint32_t /*end*/, bool /*lost*/) {});
}

void fill_lost(SampleBuffer& rows, const Window& data_window, const Columns& columns, const CleanReport& report) {
  if (!report.has_color) {
    std::fill(rows.first_sample.begin(), rows.first_sample.end(), 0);
    rows.values.clear();
    return;
  }
  const std::size_t first = first_pixel(rows.data_window, data_window), end = first + rows.data_window.pixel_count();
  const auto before = [](const LostPixel& lost, std::size_t pixel) { return lost.pixel < pixel; };
  for (auto lost = std::lower_bound(report.lost.begin(), report.lost.end(), first, before);
       lost != report.lost.end() && lost->pixel < end; ++lost)
    for (std::uint32_t i = rows.first_sample[lost->pixel - first]; i < rows.first_sample[lost->pixel - first + 1]; ++i)
      for (std::size_t c = 0; c < 3; ++c) rows.record(i)[columns.color[c]] = lost->color[c];
}

}  // namespace rpf
