// Frames that are read by rows: what the whole tells first, then the rows that a crop needs.
#include "rpf/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "frame/clean_frame.h"
#include "learned/network_file.h"
#include "learned/observe.h"
#include "plan/box.h"
#include "rpf/error.h"
#include "run/driver.h"
#include "run/informative.h"
#include "run/memory.h"
#include "run/progress_meter.h"
#include "run/row_facts.h"

namespace rpf {
namespace {

/// Of samples that are read at once where nothing asks for more.
constexpr std::uint64_t bytes_at_once = 32 << 20;

/// The end of the rows from `first` on, at least one, that are read at once.
int end_at_once(const SampleRows& rows, int first) {
  const std::uint64_t sample = rows.frame().layout.size() * sizeof(float);
  const int height = rows.frame().data_window.height;
  std::uint64_t bytes = 0;
  int end = first;
  do bytes += rows.row_samples(end++) * sample;
  while (end < height && bytes + rows.row_samples(end) * sample <= bytes_at_once);
  return end;
}

/// Calls use(rows) for all rows of a frame in turn, as long as it returns true; `tell` hears which part was done.
template <class Use, class Tell>
void for_all_rows(SampleRows& rows, const Use& use, const Tell& tell) {
  const int height = rows.frame().data_window.height;
  for (int first = 0; first < height;) {
    const int end = end_at_once(rows, first);
    SampleBuffer part = rows.read(first, end);
    if (!use(part)) return;
    tell(static_cast<double>(end - first) / height);
    first = end;
  }
}

std::uint64_t samples_in(const SampleRows& rows, int first, int end) {
  std::uint64_t samples = 0;
  for (int row = first; row < end; ++row) samples += rows.row_samples(row);
  return samples;
}

/// Refuses what is too much before it is read.
void check_rows(const SampleRows& rows, int first, int end, std::uint32_t most_samples, const Settings& settings) {
  const Window& window = rows.frame().data_window;
  const std::uint64_t need = predict_memory(
      {window.pixel_count(), samples_in(rows, first, end), most_samples, window.width}, rows.frame().layout, settings);
  constexpr double megabyte = 1 << 20;
  if (settings.max_memory > 0 && need > settings.max_memory)
    throw Error(
        ErrorKind::memory,
        fmt::format("filtering rows {} to {} needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory, lower "
                    "--threads or take fewer rows at once",
                    window.y + first, window.y + end - 1, static_cast<double>(need) / megabyte,
                    static_cast<double>(settings.max_memory) / megabyte));
}

ObservedFindings find_observed(SampleRows& rows, const Settings& settings, ProgressMeter& meter) {
  ObserveScan scan(rows.frame(), settings);
  const auto add = [&](SampleBuffer& part) {
    scan.add(part);
    return true;
  };
  for_all_rows(rows, add, [&](double part) { meter.add_part(part); });
  scan.finish();
  const Columns columns = find_columns(rows.frame(), settings.clamp_infinite);
  const auto look_again = [&](SampleBuffer& part) {
    clean_again(part, columns, settings.clamp_negative);
    scan.look_again(part);
    return scan.must_look_again();
  };
  if (scan.must_look_again()) for_all_rows(rows, look_again, [&](double /*part*/) { meter.check(); });
  return scan.findings();
}

/// What takes all samples at once.
void find_in_core(SampleRows& rows, const Settings& settings, FrameFindings& found) {
  const int height = rows.frame().data_window.height;
  check_rows(rows, 0, height, found.cleaned.most_samples, settings);
  SampleBuffer all = rows.read(0, height);
  clean_again(all, find_columns(rows.frame(), settings.clamp_infinite), settings.clamp_negative);
  PreparedFrame prepared = prepare_rows(std::move(all), rows.frame(), found, settings);
  found.feature_spread = prepared.facts.feature_spread;
  if (settings.method == Method::rpf) drop_uninformative(prepared, settings);
  found.uninformative = prepared.uninformative;
}

FrameFindings find_frame(SampleRows& rows, const Settings& settings, ProgressMeter& meter) {
  FrameScan scan(rows.frame(), settings);
  const auto add = [&](SampleBuffer& part) {
    scan.add(part);
    return true;
  };
  for_all_rows(rows, add, [&](double part) { meter.add_part(part); });
  FrameFindings found = scan.findings();
  if (settings.method == Method::cross_bilateral || (settings.method == Method::rpf && settings.drop_uninformative))
    find_in_core(rows, settings, found);
  return found;
}

/// The whole frame's, whatever the crop.
RowFacts find(SampleRows& rows, Settings settings, const Control& control) {
  validate(settings);
  settings.crop.reset();
  ProgressMeter meter(control);
  if (settings.method == Method::learned) return find_observed(rows, settings, meter);
  return find_frame(rows, settings, meter);
}

/// First and end of the rows that a crop of the frame reads.
std::pair<int, int> rows_around(const Window& crop, const SampleBuffer& frame, const Settings& settings) {
  const int y = crop.y - frame.data_window.y, height = frame.data_window.height;
  if (settings.method == Method::learned) {
    EstimatePlan plan;
    plan.network = find_network(settings.model);
    plan.width = frame.data_window.width;
    plan.height = height;
    const Window window = window_around(plan, {crop.x - frame.data_window.x, y, crop.width, crop.height});
    return {window.y, window.y + window.height};
  }
  int reach = 0;
  for (const int width : settings.box_widths) reach += box_reach(width);
  return {std::max(y - reach, 0), std::min(y + crop.height + reach, height)};
}

}  // namespace

std::string find_facts(SampleRows& rows, const Settings& settings, const Control& control) {
  return text_of(find(rows, settings, control));
}

Result filter_rows(SampleRows& rows, const Settings& settings, const std::string& facts, const Control& control) {
  validate(settings);
  const SampleBuffer& frame = rows.frame();
  const Window crop = settings.crop.value_or(frame.data_window);
  check_crop(crop, frame.data_window);
  const RowFacts found = facts.empty() ? find(rows, settings, control) : facts_of(facts, settings.method);
  const auto [first, end] = rows_around(crop, frame, settings);
  const CleanReport& cleaned = std::visit([](const auto& f) -> const CleanReport& { return f.cleaned; }, found);
  check_rows(rows, first, end, cleaned.most_samples, settings);
  return run_rows(rows.read(first, end), frame, found, settings, control);
}

}  // namespace rpf
