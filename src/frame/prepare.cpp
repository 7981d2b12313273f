#include "frame/prepare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame/clean_frame.h"
#include "frame/feature_spread.h"
#include "frame/frame_scan.h"
#include "frame/repack.h"
#include "parallel/thread_count.h"
#include "rpf/methods.h"

namespace rpf {
namespace {

/// The selected slots that vary, as sources; their names go to `names`, the names of the others to `dropped`.
void keep_varying(const SampleLayout& layout, const std::vector<std::string>& slots, const FrameFindings& found,
                  std::vector<Source>& sources, std::vector<std::string>& names, std::vector<std::string>& dropped) {
  for (const std::string& slot : slots) {
    const bool constant = std::find(found.constant.begin(), found.constant.end(), slot) != found.constant.end();
    (constant ? dropped : names).push_back(short_name(slot));
    if (!constant) sources.push_back(source_of(layout, slot));
  }
}

/// The values of a record, whose names go to `result`.
std::vector<Source> plan_records(const CleanFrame& clean, const FrameFindings& found, PreparedFrame& result) {
  std::vector<Source> variables;
  for (const std::size_t c : clean.columns.color) variables.push_back({Source::color, c, 0});
  // Relative to the data window, which is exact: where the window lies must not matter, but section 4 compares spreads
  // with magnitudes.
  const Window& window = clean.frame.data_window;
  variables.push_back({Source::plain, clean.columns.film[0], static_cast<float>(window.x)});
  variables.push_back({Source::plain, clean.columns.film[1], static_cast<float>(window.y)});
  Variables& names = result.facts.variables;
  const SampleLayout& layout = clean.frame.layout;
  keep_varying(layout, clean.selection.random, found, variables, names.random_names, result.dropped);
  keep_varying(layout, clean.selection.features, found, variables, names.feature_names, result.dropped);
  return variables;
}

}  // namespace

PreparedFrame prepare(SampleBuffer samples, const Settings& settings) {
  const SampleBuffer frame = without_samples(samples);
  FrameScan scan(frame, settings);
  scan.add(samples);
  PreparedFrame result = prepare_rows(std::move(samples), frame, scan.findings(), settings);
  if (needs_feature_spread(settings.method))
    result.facts.feature_spread = spread_of_features(result.frame, result.facts.variables);
  return result;
}

PreparedFrame prepare_rows(SampleBuffer rows, const SampleBuffer& whole, const FrameFindings& found,
                           const Settings& settings) {
  CleanFrame clean = begin_frame(whole, settings);
  take_report(clean, found.cleaned);
  take_rows(clean, std::move(rows), found.cleaned, settings.method);
  PreparedFrame& result = clean.prepared;
  result.facts.position_diagonal = found.position_diagonal;
  if (settings.method == Method::lightfield)
    result.facts.camera = camera_of(whole.metadata, whole.data_window, whole.display_window);
  const std::vector<Source> variables = plan_records(clean, found, result);
  result.colors = carried_values(clean, true);
  Frame& frame = result.frame;
  frame.variables = variables.size();
  std::vector<std::size_t> columns;
  for (const Source& source : variables) columns.push_back(source.column);
  const auto make = [&](const ColumnBlock& records, float* to) {
    for (std::size_t i = 0; i < records.count(); ++i)
      for (const Source& source : variables)
        *to++ = value_of(records[source.column][i], source, result.facts.radiance_scale);
  };
  frame.records = repack(clean.samples, variables.size(), {columns, whole.layout.size()}, thread_count(settings), make);
  frame.has_missing = std::any_of(frame.records.begin(), frame.records.end(), [](float x) { return std::isnan(x); });
  frame.first_sample =
      first_sample_in_frame(std::move(clean.samples.first_sample), clean.samples.data_window, whole.data_window);
  result.facts.feature_spread = found.feature_spread;
  return std::move(result);
}

}  // namespace rpf
