#include "frame/clean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rpf {
namespace {

/// Larger feature values count as missing: their squares would not survive a sum, and renderers write such values for
/// "no hit". Nor would sums of larger weights or alphas.
constexpr float largest_value = 1e15F;

std::vector<std::size_t> all_of(const SampleLayout& layout, std::initializer_list<const char*> slots) {
  std::vector<std::size_t> columns;
  for (const char* slot : slots)
    if (const auto column = layout.find(slot)) columns.push_back(*column);
  return columns.size() == slots.size() ? columns : std::vector<std::size_t>{};
}

/// How often something was found, and the pixel where it was found first.
struct Tally {
  std::uint64_t count = 0;
  std::size_t first_pixel = 0;

  void add(std::size_t pixel) {
    if (count++ == 0) first_pixel = pixel;
  }
};

struct Findings {
  Tally not_finite, no_weight, negative, alpha, empty;
  std::vector<Tally> missing;  ///< [column]
};

bool is_usable(const float* record, const Columns& columns, Findings& findings, std::size_t pixel) {
  const auto is_finite = [&](std::size_t c) { return std::isfinite(record[c]); };
  if (!std::all_of(std::begin(columns.color), std::end(columns.color), is_finite)) {
    findings.not_finite.add(pixel);
    return false;
  }
  if (!columns.weight || (record[*columns.weight] >= 0 && record[*columns.weight] <= largest_value)) return true;
  findings.no_weight.add(pixel);
  return false;
}

void clean_record(float* record, const Columns& columns, bool clamp_negative, Findings& findings, std::size_t pixel) {
  for (const std::size_t c : columns.color) {
    if (!(record[c] < 0)) continue;
    findings.negative.add(pixel);
    if (clamp_negative) record[c] = 0;
  }
  if (columns.alpha && !(std::fabs(record[*columns.alpha]) <= largest_value)) {
    findings.alpha.add(pixel);
    record[*columns.alpha] = 0;
  }
  const auto mark_missing = [&](std::size_t c) {
    findings.missing[c].add(pixel);
    record[c] = missing;
  };
  for (const std::size_t c : columns.film)
    if (!(std::fabs(record[c]) <= largest_value)) mark_missing(c);
  for (const std::size_t c : columns.variables)
    if (!(std::fabs(record[c]) <= largest_value)) mark_missing(c);
}

std::vector<InputNote> notes_of(const Findings& findings, const SampleBuffer& samples, bool clamp_negative) {
  std::vector<InputNote> notes;
  const auto width = static_cast<std::size_t>(samples.data_window.width);
  const auto tell = [&](const Tally& tally, const std::string& what) {
    if (tally.count == 0) return;
    notes.push_back({what, tally.count, samples.data_window.x + static_cast<int>(tally.first_pixel % width),
                     samples.data_window.y + static_cast<int>(tally.first_pixel / width)});
  };
  tell(findings.not_finite, "samples left out: R, G or B not finite");
  tell(findings.no_weight, "samples left out: weight not a number from 0 to 1e15");
  tell(findings.empty, "pixels without samples, black");
  tell(findings.negative, clamp_negative ? "negative radiance values, set to 0" : "negative radiance values, kept");
  tell(findings.alpha, "values of alpha not finite or beyond 1e15, set to 0");
  for (std::size_t c = 0; c < findings.missing.size(); ++c)
    tell(findings.missing[c], fmt::format("missing values of {}", samples.layout.slots[c]));
  return notes;
}

}  // namespace

Columns find_columns(const SampleLayout& layout) {
  Columns c;
  const auto color = all_of(layout, {"R", "G", "B"});
  const auto film = all_of(layout, {"film.X", "film.Y"});
  std::copy(color.begin(), color.end(), c.color);
  std::copy(film.begin(), film.end(), c.film);
  c.alpha = layout.find("A");
  c.weight = layout.find("weight");
  c.hit = layout.find("feature.hit");
  c.normal = all_of(layout, {"feature.N.X", "feature.N.Y", "feature.N.Z"});
  for (std::size_t i = 0; i < layout.size(); ++i)
    if (is_feature_slot(layout.slots[i]) && group_of(layout.slots[i]) == "P") c.position.push_back(i);
  for (std::size_t i = 0; i < layout.size(); ++i)
    if (is_random_slot(layout.slots[i]) || is_feature_slot(layout.slots[i])) c.variables.push_back(i);
  return c;
}

std::vector<InputNote> clean(SampleBuffer& samples, const Columns& columns, bool clamp_negative) {
  const std::size_t stride = samples.layout.size();
  Findings findings;
  findings.missing.resize(stride);
  std::uint32_t kept = 0;
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel) {
    const std::uint32_t begin = std::exchange(samples.first_sample[pixel], kept);
    for (std::uint32_t sample = begin; sample < samples.first_sample[pixel + 1]; ++sample) {
      float* record = samples.record(sample);
      if (!is_usable(record, columns, findings, pixel)) continue;
      clean_record(record, columns, clamp_negative, findings, pixel);
      if (sample != kept) std::copy(record, record + stride, samples.record(kept));
      ++kept;
    }
    if (samples.first_sample[pixel] == kept) findings.empty.add(pixel);
  }
  samples.first_sample.back() = kept;
  samples.values.resize(kept * stride);
  return notes_of(findings, samples, clamp_negative);
}

}  // namespace rpf
