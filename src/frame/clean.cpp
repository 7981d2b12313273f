#include "frame/clean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "frame/glance.h"
#include "frame/lost_pixels.h"
#include "frame/sample_cleaner.h"
#include "frame/variables.h"
#include "parallel/thread_count.h"
#include "parallel/workers.h"

namespace rpf {
namespace {

constexpr float largest_half = 65504;

std::vector<std::size_t> all_of(const SampleLayout& layout, std::initializer_list<const char*> slots) {
  std::vector<std::size_t> columns;
  for (const char* slot : slots)
    if (const auto column = layout.find(slot)) columns.push_back(*column);
  return columns.size() == slots.size() ? columns : std::vector<std::size_t>{};
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

/// `has_color`: of any pixel; lost pixels have none to be filled with else.
std::vector<InputNote> notes_of(const CleanFindings& findings, const SampleBuffer& samples, bool clamp_negative,
                                bool has_color) {
  std::vector<InputNote> notes;
  const auto tell = [&](const Tally& tally, const std::string& what) { tally.tell(what, samples.data_window, notes); };
  tell(findings.infinite, "infinite radiance values, taken for the largest of their type");
  tell(findings.not_finite, "samples left out: R, G or B not finite");
  tell(findings.no_weight, "samples left out: weight not a number from 0 to 1e15");
  tell(findings.lost, has_color ? "pixels that lost all their samples, filled from their neighbors"
                                : "pixels that lost all their samples, black: no pixel has any left");
  tell(findings.empty, "pixels without samples, black");
  tell(findings.weightless, "pixels whose samples all have weight 0");
  tell(findings.negative, clamp_negative ? "negative radiance values, set to 0" : "negative radiance values, kept");
  tell(findings.alpha, "values of alpha not finite or beyond 1e15, set to 0");
  tell(findings.missing, "samples with missing values of " + list_of(findings.missing_columns, samples.layout));
  return notes;
}

bool is_any_marked(const Marks& marks, std::uint32_t begin, std::uint32_t end) {
  return std::any_of(marks.begin() + begin, marks.begin() + end, [](std::uint8_t mark) { return mark != 0; });
}

/// Pixels that a thread looks at: from where to before where their samples, some thousand, are in its cache twice.
std::vector<std::size_t> parts_of(const SampleBuffer& rows) {
  constexpr std::uint32_t samples_of_part = 2048;
  std::vector<std::size_t> ends = {0};
  const std::size_t pixels = rows.first_sample.size() - 1;
  for (std::size_t place = 1; place <= pixels; ++place)
    if (place == pixels || rows.first_sample[place] - rows.first_sample[ends.back()] >= samples_of_part)
      ends.push_back(place);
  return ends;
}

/// Looks at all samples, part by part on so many threads, with copies of `glance`; `after` hears the number of each
/// part and of its pixels. Returns the largest magnitude of the clean samples' colors.
template <class After>
float mark_all(const SampleBuffer& rows, const std::vector<std::size_t>& parts, const Glance& glance, int threads,
               Marks& marks, const After& after) {
  Workers workers(threads);
  std::vector<Glance> glances(workers.count(), glance);
  workers.for_all(1, parts.size(), [&](std::size_t n, std::size_t worker) {
    glances[worker].look(rows, parts[n - 1], parts[n], marks.data());
    after(n, parts[n - 1], parts[n]);
  });
  float brightest = 0;
  for (const Glance& own : glances) brightest = std::max(brightest, own.brightest());
  return brightest;
}

/// Cleans what is marked and moves all samples together. `before` hears of a pixel with marked samples, which are still
/// as they were; `after` of every pixel, which samples it keeps.
template <class Before, class After>
void clean_marked(SampleBuffer& rows, std::size_t first, const Marks& marks, SampleCleaner cleaner,
                  const Before& before, const After& after) {
  std::uint32_t kept = 0;
  for (std::size_t place = 0; place + 1 < rows.first_sample.size(); ++place) {
    const std::uint32_t begin = std::exchange(rows.first_sample[place], kept), end = rows.first_sample[place + 1];
    const bool is_marked = is_any_marked(marks, begin, end);
    cleaner.count_pixel(rows, begin, end, first + place);
    if (is_marked) {
      before(place, begin, end);
      kept += cleaner.keep_samples(rows, begin, end, kept, marks, first + place);
    } else {
      move_samples(rows, begin, end, kept);
      kept += end - begin;
    }
    after(place, rows.first_sample[place], kept, is_marked);
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
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (is_random_slot(layout.slots[i])) c.random.push_back(i);
    if (!is_feature_slot(layout.slots[i])) continue;
    const std::string group = group_of(layout.slots[i]);
    if (group == "P") c.position.push_back(i);
    (is_second_hit(group) ? c.second_hit : c.first_hit).push_back(i);
  }
  return c;
}

std::size_t first_pixel(const Window& rows, const Window& data_window) {
  return static_cast<std::size_t>(rows.y - data_window.y) * static_cast<std::size_t>(data_window.width);
}

Cleaning::Cleaning(const SampleBuffer& frame, const Columns& columns, const Settings& settings)
    : frame_(frame),
      columns_(columns),
      clamp_negative_(settings.clamp_negative),
      threads_(thread_count(settings)),
      conventions_(frame),
      colors_(frame.data_window.pixel_count()) {
  findings_.missing_columns.resize(frame.layout.size());
}

void Cleaning::add(SampleBuffer& rows, const Seen& seen) {
  const std::size_t first = first_pixel(rows.data_window, frame_.data_window);
  const Marks marks = look(rows, first, seen);
  clean_marked(
      rows, first, marks, SampleCleaner(columns_, clamp_negative_, findings_),
      [&](std::size_t place, std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i)
          if ((marks[i] & odd) != 0) conventions_.add(rows.record(i), first + place);
      },
      [&](std::size_t place, std::uint32_t begin, std::uint32_t end, bool is_marked) {
        most_samples_ = std::max(most_samples_, end - begin);
        const bool is_lost = findings_.lost.count > lost_.size();
        if (is_lost) lost_.push_back({first + place, end - begin, {}});
        if (!is_marked) return;
        const ColorSum sum = sum_of_colors(rows, columns_, begin, end);
        if (!is_lost) colors_[first + place] = mean_of(sum);
        if (seen) seen(place, begin, end, sum);
      });
}

/// On all threads; also what is to be known of the pixels that are clean.
Marks Cleaning::look(const SampleBuffer& rows, std::size_t first, const Seen& seen) {
  const std::vector<std::size_t> parts = parts_of(rows);
  std::vector<Conventions::Found> found(parts.size());
  Marks marks(rows.sample_count());
  const auto include_pixels = [&](std::size_t n, std::size_t place, std::size_t end_of_part) {
    for (; place < end_of_part; ++place) {
      const std::uint32_t begin = rows.first_sample[place], end = rows.first_sample[place + 1];
      conventions_.look(rows, place, first + place, found[n]);
      if (is_any_marked(marks, begin, end)) continue;
      const ColorSum sum = sum_of_colors(rows, columns_, begin, end);
      colors_[first + place] = mean_of(sum);
      if (seen) seen(place, begin, end, sum);
    }
  };
  const Glance glance(rows.layout, columns_, &conventions_);
  findings_.brightest = std::max(findings_.brightest, mark_all(rows, parts, glance, threads_, marks, include_pixels));
  for (const Conventions::Found& of_part : found) conventions_.add(of_part);
  return marks;
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
    most_samples_ = 0;
  }
  report.most_samples = most_samples_;
  report.brightest = findings_.brightest;
  report.lacks_positions = lacks_positions();
  report.notes = conventions_.notes(frame_.data_window);
  std::vector<InputNote> found = notes_of(findings_, frame_, clamp_negative_, report.has_color);
  std::move(found.begin(), found.end(), std::back_inserter(report.notes));
  return report;
}

void clean_again(SampleBuffer& rows, const Columns& columns, const Settings& settings) {
  const auto ignore = [](auto... /*what was found before*/) {};
  Marks marks(rows.sample_count());
  mark_all(rows, parts_of(rows), Glance(rows.layout, columns, nullptr), thread_count(settings), marks, ignore);
  CleanFindings found_before;
  found_before.missing_columns.resize(rows.layout.size());
  clean_marked(rows, 0, marks, SampleCleaner(columns, settings.clamp_negative, found_before), ignore, ignore);
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
