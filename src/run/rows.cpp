// Frames that are read by rows: what the whole tells first, then the rows that a crop needs.
#include "rpf/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "learned/estimate_plan.h"
#include "learned/network_file.h"
#include "plan/box.h"
#include "rpf/error.h"
#include "rpf/methods.h"
#include "rpf/outputs.h"
#include "run/backends.h"
#include "run/driver.h"
#include "run/estimate_bands.h"
#include "run/memory.h"
#include "run/pass_bands.h"
#include "run/row_facts.h"
#include "run/row_scan.h"

namespace rpf {
namespace {

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

/// Keeps rows of the first walk for the second one where all of them would not fit for certain.
RowWalk walk_of(const SampleRows& rows, int first, int end, const Settings& settings) {
  RowWalk walk;
  walk.first = first;
  walk.end = end;
  if (settings.method != Method::learned || settings.max_memory == 0 ||
      rows_need(rows, first, end, 0, settings) <= settings.max_memory)
    return walk;
  constexpr std::uint64_t per_pixel = 64;  // what is known of each meanwhile
  const std::uint64_t need = per_pixel * rows.frame().data_window.pixel_count() + 3 * walk.at_once;
  walk.kept_bytes = settings.max_memory > need ? (settings.max_memory - need) / 4 * 3 : 0;
  return walk;
}

/// Refuses what is too much even so.
void check_streamed(const SampleRows& rows, std::uint32_t most_samples, const Settings& settings) {
  constexpr double megabyte = 1 << 20;
  const std::uint64_t need = predict_rows_memory(rows, most_samples, settings).bytes;
  if (need > settings.max_memory)
    throw Error(
        ErrorKind::memory,
        fmt::format("filtering needs {:.0f} MB even where rows are read as they are needed, the limit is {:.0f} "
                    "MB; raise --max-memory, lower --threads or filter a part with --rows",
                    static_cast<double>(need) / megabyte, static_cast<double>(settings.max_memory) / megabyte));
}

}  // namespace

std::string find_facts(SampleRows& rows, const Settings& settings, const Control& control) {
  return text_of(scan_rows(rows, settings, control).facts);
}

Result filter_rows(SampleRows& rows, const Settings& settings, const std::string& facts, const Control& control) {
  validate(settings);
  if (settings.estimate_error)
    throw Error(ErrorKind::usage, "--error: filters halves of the whole frame's samples; leave --rows and --facts out");
  const SampleBuffer& frame = rows.frame();
  const Window crop = settings.crop.value_or(frame.data_window);
  check_crop(crop, frame.data_window);
  const auto [first, end] = rows_around(crop, frame, settings);
  const RowWalk walk = walk_of(rows, first, end, settings);
  ScannedRows scanned;
  if (facts.empty())
    scanned = scan_rows(rows, settings, control, walk);
  else
    scanned.facts = facts_of(facts, settings.method);
  const CleanReport& cleaned = std::visit([](const auto& f) -> const CleanReport& { return f.cleaned; }, scanned.facts);
  const auto* observed = std::get_if<ObservedFindings>(&scanned.facts);
  const std::uint64_t need = rows_need(rows, first, end, cleaned.most_samples, settings);
  if (!can_stream(settings) || settings.max_memory == 0 || need <= settings.max_memory) {
    check_rows(rows, first, end, cleaned.most_samples, settings);
    scanned.first_sample = {};
    scanned.kept = {};
    return run_rows(rows.read(first, end), frame, scanned.facts, settings, control);
  }
  check_streamed(rows, cleaned.most_samples, settings);
  if (observed == nullptr) {
    const std::uint64_t at_once = pass_bands(rows, cleaned.most_samples, settings, *make_backend(settings)).at_once;
    return run_streamed(rows, std::move(scanned), settings, control, at_once);
  }
  if (scanned.first_sample.empty()) count_rows(rows, walk, cleaned, settings, scanned);
  return run_streamed(rows, std::move(scanned), settings, control);
}

bool can_stream(const Settings& settings) {
  return !needs_whole_frame(settings.method) && !settings.estimate_error &&
         !(settings.method == Method::rpf && settings.drop_uninformative);
}

RowsMemory predict_rows_memory(const SampleRows& rows, std::uint32_t max_samples_per_pixel, const Settings& settings) {
  const std::unique_ptr<Backend> backend = make_backend(settings);
  if (settings.method != Method::learned) {
    const PassBands bands = pass_bands(rows, max_samples_per_pixel, settings, *backend);
    return {bands.bytes, bands.rows_read, bands.rows_held};
  }
  const RawSize raw = streamed_size(rows, max_samples_per_pixel);
  const EstimateBands bands = estimate_bands(raw.size, raw.layout, raw.room, settings, *backend);
  return {bands.bytes, rows.end_within(0, bytes_at_once), 0};
}

}  // namespace rpf
