#include "run/row_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "frame/clean_frame.h"
#include "frame/feature_spread.h"
#include "frame/prepare.h"
#include "rpf/error.h"
#include "rpf/methods.h"
#include "run/informative.h"
#include "run/progress_meter.h"
#include "run/row_window.h"

namespace rpf {
namespace {

/// Calls use(rows) for all rows of a frame in turn, as long as it returns true; `tell` hears which part was done.
template <class Use, class Tell>
void for_all_rows(SampleRows& rows, std::uint64_t at_once, const Use& use, const Tell& tell) {
  const int height = rows.frame().data_window.height;
  for (int first = 0; first < height;) {
    const int end = rows.end_within(first, at_once);
    SampleBuffer part = rows.read(first, end);
    if (!use(part)) return;
    tell(static_cast<double>(end - first) / height);
    first = end;
  }
}

/// Adds the samples of every pixel of cleaned rows to the sums so far.
void count(const SampleBuffer& part, std::vector<std::uint32_t>& first_sample) {
  const std::uint32_t before = first_sample.back();
  for (std::size_t pixel = 1; pixel < part.first_sample.size(); ++pixel)
    first_sample.push_back(before + part.first_sample[pixel]);
}

/// Keeps the first rows that it is given, as the walk says.
class Keeper {
 public:
  Keeper(const RowWalk& walk, const SampleBuffer& frame, std::vector<SampleBuffer>& kept)
      : walk_(walk), top_(frame.data_window.y), left_(walk.kept_bytes), kept_(kept) {}

  void offer(SampleBuffer& part) {
    const int first = part.data_window.y - top_, end = first + part.data_window.height;
    const std::uint64_t bytes = part.values.capacity() * sizeof(float);
    if (end <= walk_.first || walk_.end <= first) return;
    left_ = bytes <= left_ ? left_ - bytes : 0;  // what comes later is needed later
    if (left_ > 0) kept_.push_back(std::move(part));
  }

 private:
  const RowWalk& walk_;
  int top_;
  std::uint64_t left_;
  std::vector<SampleBuffer>& kept_;
};

ObservedFindings find_observed(SampleRows& rows, const Settings& settings, ProgressMeter& meter, const RowWalk& walk,
                               ScannedRows& scanned) {
  const std::uint64_t at_once = walk.at_once;
  ObserveScan scan(rows.frame(), settings);
  std::vector<std::uint32_t>& first_sample = scanned.first_sample = {0};
  first_sample.reserve(rows.frame().data_window.pixel_count() + 1);
  Keeper keeper(walk, rows.frame(), scanned.kept);
  const auto add = [&](SampleBuffer& part) {
    scan.add(part);
    count(part, first_sample);
    keeper.offer(part);
    return true;
  };
  for_all_rows(rows, at_once, add, [&](double part) { meter.add_part(part); });
  if (!scan.finish()) std::fill(first_sample.begin(), first_sample.end(), 0U);
  const Columns columns = find_columns(rows.frame(), settings.clamp_infinite);
  const auto look_again = [&](SampleBuffer& part) {
    clean_again(part, columns, settings);
    scan.look_again(part);
    return scan.must_look_again();
  };
  if (scan.must_look_again()) for_all_rows(rows, at_once, look_again, [&](double /*part*/) { meter.check(); });
  return scan.findings();
}

/// Means first and then, of all rows once more, deviations.
std::vector<FeatureSpread> find_spread(SampleRows& rows, const Settings& settings, const FrameFindings& found,
                                       ProgressMeter& meter, std::uint64_t at_once) {
  const PreparedFrame known = prepare_without_samples(rows.frame(), found, settings);
  FeatureSpreadScan scan(known.facts.variables);
  const auto for_all = [&](void (FeatureSpreadScan::*add)(const Frame&)) {
    const auto use = [&](SampleBuffer& part) {
      (scan.*add)(prepare_again(std::move(part), rows.frame(), found, settings).frame);
      return true;
    };
    for_all_rows(rows, at_once, use, [&](double /*part*/) { meter.check(); });
  };
  for_all(&FeatureSpreadScan::add);
  for_all(&FeatureSpreadScan::add_again);
  return scan.spread();
}

/// Which channels tell nothing takes all samples at once.
std::vector<std::string> find_uninformative(SampleRows& rows, const Settings& settings, const FrameFindings& found) {
  const int height = rows.frame().data_window.height;
  check_rows(rows, 0, height, found.cleaned.most_samples, settings);
  SampleBuffer all = rows.read(0, height);
  clean_again(all, find_columns(rows.frame(), settings.clamp_infinite), settings);
  PreparedFrame prepared = prepare_rows(std::move(all), rows.frame(), found, settings);
  drop_uninformative(prepared, settings);
  return prepared.uninformative;
}

FrameFindings find_frame(SampleRows& rows, const Settings& settings, ProgressMeter& meter, std::uint64_t at_once) {
  FrameScan scan(rows.frame(), settings);
  const auto add = [&](SampleBuffer& part) {
    scan.add(part);
    return true;
  };
  for_all_rows(rows, at_once, add, [&](double part) { meter.add_part(part); });
  FrameFindings found = scan.findings();
  if (settings.method == Method::cross_bilateral)
    found.feature_spread = find_spread(rows, settings, found, meter, at_once);
  if (settings.method == Method::rpf && settings.drop_uninformative)
    found.uninformative = find_uninformative(rows, settings, found);
  return found;
}

}  // namespace

ScannedRows scan_rows(SampleRows& rows, Settings settings, const Control& control, const RowWalk& walk) {
  validate(settings);
  if (needs_whole_frame(settings.method))
    throw Error(ErrorKind::usage,
                fmt::format("method {} filters the whole frame at once, so rows of it cannot be "
                            "filtered by themselves; filter the frame, with --crop if a part is enough",
                            name_of(settings.method)));
  settings.crop.reset();
  ProgressMeter meter(control);
  ScannedRows scanned;
  if (settings.method == Method::learned)
    scanned.facts = find_observed(rows, settings, meter, walk, scanned);
  else
    scanned.facts = find_frame(rows, settings, meter, walk.at_once);
  return scanned;
}

void count_rows(SampleRows& rows, const RowWalk& walk, const CleanReport& cleaned, const Settings& settings,
                ScannedRows& scanned) {
  const Window& window = rows.frame().data_window;
  const Columns columns = find_columns(rows.frame(), settings.clamp_infinite);
  std::vector<std::uint32_t> counted = {0};
  Keeper keeper(walk, rows.frame(), scanned.kept);
  int first = 0, end = 0;  // of what is read: as where all rows are
  for (int row = 0, next = 0; row < walk.end; row = next) {
    next = rows.end_within(row, walk.at_once);
    if (next <= walk.first) continue;
    if (end == 0) first = row;
    end = next;
    SampleBuffer part = rows.read(row, next);
    clean_again(part, columns, settings);
    count(part, counted);
    keeper.offer(part);
  }
  if (!cleaned.has_color) std::fill(counted.begin(), counted.end(), 0U);
  scanned.first_sample =
      first_sample_in_frame(std::move(counted), {window.x, window.y + first, window.width, end - first}, window);
}

std::uint64_t rows_need(const SampleRows& rows, int first, int end, std::uint32_t most_samples,
                        const Settings& settings) {
  const Window& window = rows.frame().data_window;
  return predict_memory({window.pixel_count(), rows.sample_count(first, end), most_samples, window.width},
                        rows.frame().layout, settings);
}

void check_rows(const SampleRows& rows, int first, int end, std::uint32_t most_samples, const Settings& settings) {
  const Window& window = rows.frame().data_window;
  const std::uint64_t need = rows_need(rows, first, end, most_samples, settings);
  constexpr double megabyte = 1 << 20;
  if (settings.max_memory > 0 && need > settings.max_memory)
    throw Error(
        ErrorKind::memory,
        fmt::format("filtering rows {} to {} needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory, lower "
                    "--threads or take fewer rows at once",
                    window.y + first, window.y + end - 1, static_cast<double>(need) / megabyte,
                    static_cast<double>(settings.max_memory) / megabyte));
}

}  // namespace rpf
