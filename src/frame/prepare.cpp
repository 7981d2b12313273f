#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "frame/clean_frame.h"
#include "frame/feature_spread.h"
#include "frame/repack.h"

namespace rpf {
namespace {

/// One value of a new record: a column of the old one, or what is computed from it.
struct Source {
  enum Kind { color, plain, fraction } kind = plain;
  std::size_t column = 0;
  float origin = 0;  ///< subtracted from a plain value
};

bool is_hit(const float* record, const Columns& columns) {
  if (columns.hit) return record[*columns.hit] != 0;
  const auto is_zero = [&](std::size_t c) { return record[c] == 0; };
  return columns.normal.empty() || !std::all_of(columns.normal.begin(), columns.normal.end(), is_zero);
}

/// The diagonal of the box around all first-hit world positions, missed rays left out; 0 without positions.
float position_diagonal(const SampleBuffer& samples, const Columns& columns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> low(columns.position.size(), infinity), high(columns.position.size(), -infinity);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    const float* record = samples.record(i);
    const auto is_missing = [&](std::size_t c) { return std::isnan(record[c]); };
    if (!is_hit(record, columns) || std::any_of(columns.position.begin(), columns.position.end(), is_missing)) continue;
    for (std::size_t k = 0; k < low.size(); ++k) {
      low[k] = std::min<double>(low[k], record[columns.position[k]]);
      high[k] = std::max<double>(high[k], record[columns.position[k]]);
    }
  }
  double square = 0;
  for (std::size_t k = 0; k < low.size(); ++k)
    square += high[k] >= low[k] ? (high[k] - low[k]) * (high[k] - low[k]) : 0;
  return static_cast<float>(std::sqrt(square));
}

float value_of(const float* record, const Source& source, float scale) {
  const float value = record[source.column];
  if (source.kind == Source::color) return value * scale;
  return source.kind == Source::fraction ? value - std::floor(value) : value - source.origin;
}

bool is_constant(const SampleBuffer& samples, const Source& source) {
  float first = missing;
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    const float value = value_of(samples.record(i), source, 1);
    if (std::isnan(first)) first = value;
    if (value < first || value > first) return false;
  }
  return true;
}

Source source_of(const SampleLayout& layout, const std::string& slot) {
  if (slot == "pixel.X") return {Source::fraction, *layout.find("film.X"), 0};
  if (slot == "pixel.Y") return {Source::fraction, *layout.find("film.Y"), 0};
  return {Source::plain, *layout.find(slot), 0};
}

/// The selected slots that vary, as sources; their names go to `names`, the names of the others to `dropped`.
void keep_varying(const SampleBuffer& samples, const std::vector<std::string>& slots, std::vector<Source>& sources,
                  std::vector<std::string>& names, std::vector<std::string>& dropped) {
  for (const std::string& slot : slots) {
    const Source source = source_of(samples.layout, slot);
    const bool constant = is_constant(samples, source);
    (constant ? dropped : names).push_back(short_name(slot));
    if (!constant) sources.push_back(source);
  }
}

}  // namespace

PreparedFrame prepare(SampleBuffer read, const Settings& settings) {
  CleanFrame clean = clean_frame(std::move(read), settings);
  SampleBuffer& samples = clean.samples;
  PreparedFrame& result = clean.prepared;
  result.facts.position_diagonal = position_diagonal(samples, clean.columns);

  std::vector<Source> variables;
  for (const std::size_t c : clean.columns.color) variables.push_back({Source::color, c, 0});
  // Relative to the data window, which is exact: where the window lies must not matter, but section 4 compares spreads
  // with magnitudes.
  variables.push_back({Source::plain, clean.columns.film[0], static_cast<float>(samples.data_window.x)});
  variables.push_back({Source::plain, clean.columns.film[1], static_cast<float>(samples.data_window.y)});
  Variables& names = result.facts.variables;
  keep_varying(samples, clean.selection.random, variables, names.random_names, result.dropped);
  keep_varying(samples, clean.selection.features, variables, names.feature_names, result.dropped);

  result.colors = carried_values(clean, true);
  Frame& frame = result.frame;
  frame.variables = variables.size();
  const auto make = [&, stride = samples.layout.size()](const float* records, float* to, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      for (const Source& source : variables)
        *to++ = value_of(records + i * stride, source, result.facts.radiance_scale);
  };
  frame.records = repack(samples, variables.size(), make);
  frame.has_missing = std::any_of(frame.records.begin(), frame.records.end(), [](float x) { return std::isnan(x); });
  frame.first_sample = std::move(samples.first_sample);
  if (settings.method == Method::cross_bilateral || settings.method == Method::sbf)
    result.facts.feature_spread = spread_of_features(frame, result.facts.variables);
  return std::move(result);
}

}  // namespace rpf
