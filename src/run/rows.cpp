// Frames that are read by rows: what the whole tells first, then the rows that a crop needs.
#include "rpf/rows.h"

#include <algorithm>
#include <utility>

#include "learned/estimate_plan.h"
#include "learned/network_file.h"
#include "plan/box.h"
#include "rpf/outputs.h"
#include "run/driver.h"
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

}  // namespace

std::string find_facts(SampleRows& rows, const Settings& settings, const Control& control) {
  return text_of(scan_rows(rows, settings, control));
}

Result filter_rows(SampleRows& rows, const Settings& settings, const std::string& facts, const Control& control) {
  validate(settings);
  const SampleBuffer& frame = rows.frame();
  const Window crop = settings.crop.value_or(frame.data_window);
  check_crop(crop, frame.data_window);
  const RowFacts found = facts.empty() ? scan_rows(rows, settings, control) : facts_of(facts, settings.method);
  const auto [first, end] = rows_around(crop, frame, settings);
  const CleanReport& cleaned = std::visit([](const auto& f) -> const CleanReport& { return f.cleaned; }, found);
  check_rows(rows, first, end, cleaned.most_samples, settings);
  return run_rows(rows.read(first, end), frame, found, settings, control);
}

}  // namespace rpf
