#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "frame/clean.h"
#include "frame/feature_spread.h"
#include "frame/prepare.h"
#include "frame/selection.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf {
namespace {

/// The brightest value of the frame is brought to [2^40, 2^41): squares and sums of millions of them stay finite, and
/// values 2^-166 times as bright are still normal numbers.
constexpr int brightest_exponent = 40;

/// One value of a new record: a column of the old one, or what is computed from it.
struct Source {
  enum Kind { color, plain, fraction } kind = plain;
  std::size_t column = 0;
  float origin = 0;  ///< subtracted from a plain value
};

/// The power of two that brings the brightest value to [2^40, 2^41); 1 for a black frame.
float radiance_scale(const SampleBuffer& samples, const Columns& columns) {
  float brightest = 0;
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const std::size_t c : columns.color) brightest = std::max(brightest, std::fabs(samples.record(i)[c]));
  // The scale itself must be a normal float whose inverse is one too, also for subnormal radiance.
  return brightest > 0 ? std::ldexp(1.0F, std::clamp(brightest_exponent - std::ilogb(brightest), -126, 126)) : 1.0F;
}

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

/// "lens.U" of "random.lens.U".
std::string short_name(const std::string& slot) {
  return is_random_slot(slot) || is_feature_slot(slot) ? slot.substr(slot.find('.') + 1) : slot;
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

/// The selected slots and the mask of hits, whether they vary or not: the learned estimator finds that out itself.
void keep_all(const SampleLayout& layout, const Selection& selection, std::vector<Source>& sources, Variables& names) {
  const auto keep = [&](const std::string& slot, std::vector<std::string>& into) {
    sources.push_back(source_of(layout, slot));
    into.push_back(short_name(slot));
  };
  for (const std::string& slot : selection.random) keep(slot, names.random_names);
  for (const std::string& slot : selection.features) keep(slot, names.feature_names);
  if (const auto hit = layout.find("feature.hit")) {
    sources.push_back({Source::plain, *hit, 0});
    names.feature_names.emplace_back("hit");
  }
}

/// What is averaged beside the color: alpha where the file has it, all features where they are wanted.
std::vector<Source> carried_sources(const SampleLayout& layout, const Columns& columns, const Settings& settings,
                                    std::vector<std::string>& names) {
  std::vector<Source> sources;
  names = {"R", "G", "B"};
  for (const std::size_t c : columns.color) sources.push_back({Source::color, c, 0});
  if (columns.alpha) {
    sources.push_back({Source::plain, *columns.alpha, 0});
    names.emplace_back("A");
  }
  for (std::size_t c = 0; settings.filter_features && c < layout.size(); ++c) {
    if (!is_feature_slot(layout.slots[c])) continue;
    sources.push_back({Source::plain, c, 0});
    names.push_back(short_name(layout.slots[c]));
  }
  return sources;
}

std::vector<float> carried_values(const SampleBuffer& samples, const std::vector<Source>& sources, float scale) {
  std::vector<float> values;
  values.reserve(samples.sample_count() * sources.size());
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const Source& source : sources) {
      const float value = value_of(samples.record(i), source, scale);
      values.push_back(std::isnan(value) ? 0.0F : value);  // a missing feature has nothing to average
    }
  return values;
}

/// Distances on the film need a position: a sample that has none is in the middle of its pixel.
void center_missing_positions(SampleBuffer& samples, const Columns& columns) {
  const Window& w = samples.data_window;
  for (std::size_t pixel = 0; pixel < w.pixel_count(); ++pixel)
    for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 1]; ++i) {
      const int place[2] = {w.x + static_cast<int>(pixel) % w.width, w.y + static_cast<int>(pixel) / w.width};
      for (int axis = 0; axis < 2; ++axis) {
        float& value = samples.record(i)[columns.film[axis]];
        if (std::isnan(value)) value = static_cast<float>(place[axis]) + 0.5F;
      }
    }
}

std::vector<float> sample_weights(const SampleBuffer& samples, const Columns& columns) {
  std::vector<float> weights;
  for (std::size_t i = 0; columns.weight && i < samples.sample_count(); ++i)
    weights.push_back(samples.record(i)[*columns.weight]);
  return weights;
}

/// Gives the memory behind the last element back: shrink_to_fit() would copy, and need both at once.
void release_tail(std::vector<float>& values) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.size());
  const auto capacity = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity());
  const std::uintptr_t first = (end + page - 1) / page * page, last = capacity / page * page;
  // What is given back reads as zeros afterwards; nothing but a vector that grows again will look.
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);  // NOLINT
}

/// Records of `sources` in the place of the buffer's own where there is room; its values are gone afterwards. Longer
/// records are made from the last on, so that none overwrites one that is still to be read.
std::vector<float> repack(SampleBuffer& samples, const std::vector<Source>& sources, float scale) {
  const std::size_t count = samples.sample_count(), from = samples.layout.size(), to = sources.size();
  std::vector<float> elsewhere;
  const bool in_place = count * to <= samples.values.capacity();
  std::vector<float>& target = in_place ? samples.values : elsewhere;
  target.resize(count * std::max(in_place ? from : 0, to));
  std::vector<float> record(from);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = to > from ? count - 1 - n : n;
    std::copy_n(samples.values.data() + i * from, from, record.begin());
    for (std::size_t v = 0; v < to; ++v) target[i * to + v] = value_of(record.data(), sources[v], scale);
  }
  target.resize(count * to);
  release_tail(target);
  return std::move(target);
}

/// The crop in frame coordinates; the whole frame without one.
Window wanted_region(const Window& data_window, const std::optional<Window>& crop) {
  const Window c = crop.value_or(data_window);
  check_crop(c, data_window);
  return {c.x - data_window.x, c.y - data_window.y, c.width, c.height};
}

}  // namespace

void check_crop(const Window& crop, const Window& data_window) {
  const std::int64_t x = std::int64_t{crop.x} - data_window.x, y = std::int64_t{crop.y} - data_window.y;
  const bool inside = x >= 0 && y >= 0 && crop.width > 0 && crop.height > 0 && x + crop.width <= data_window.width &&
                      y + crop.height <= data_window.height;
  if (!inside)
    throw Error(ErrorKind::usage, fmt::format("--crop {} is not inside the data window {}; choose a part of it",
                                              text_of(crop), text_of(data_window)));
}

std::uint32_t most_samples(const std::vector<std::uint32_t>& first_sample) {
  std::uint32_t most = 0;
  for (std::size_t p = 0; p + 1 < first_sample.size(); ++p)
    most = std::max(most, first_sample[p + 1] - first_sample[p]);
  return most;
}

PreparedFrame prepare(SampleBuffer samples, const Settings& settings) {
  const Columns columns = find_columns(samples, settings.clamp_infinite);
  const Selection selection = select_channels(samples.layout, settings);
  PreparedFrame result;
  result.facts.crop = wanted_region(samples.data_window, settings.crop);
  result.notes = check_conventions(samples);
  for (InputNote& note : clean(samples, columns, settings.clamp_negative)) result.notes.push_back(std::move(note));
  if (settings.method != Method::rpf) center_missing_positions(samples, columns);
  result.facts.radiance_scale = radiance_scale(samples, columns);
  result.facts.position_diagonal = position_diagonal(samples, columns);

  std::vector<Source> variables;
  for (const std::size_t c : columns.color) variables.push_back({Source::color, c, 0});
  // Relative to the data window, which is exact: where the window lies must not matter, but section 4 compares spreads
  // with magnitudes.
  variables.push_back({Source::plain, columns.film[0], static_cast<float>(samples.data_window.x)});
  variables.push_back({Source::plain, columns.film[1], static_cast<float>(samples.data_window.y)});
  if (settings.method == Method::learned) {
    keep_all(samples.layout, selection, variables, result.facts.variables);
  } else {
    keep_varying(samples, selection.random, variables, result.facts.variables.random_names, result.dropped);
    keep_varying(samples, selection.features, variables, result.facts.variables.feature_names, result.dropped);
  }
  const auto carried = carried_sources(samples.layout, columns, settings, result.carried_names);

  Frame& frame = result.frame;
  frame.width = result.facts.width = samples.data_window.width;
  frame.height = result.facts.height = samples.data_window.height;
  frame.variables = variables.size();
  result.facts.carried = carried.size();
  result.colors = carried_values(samples, carried, result.facts.radiance_scale);
  frame.weights = sample_weights(samples, columns);
  frame.records = repack(samples, variables, result.facts.radiance_scale);
  frame.has_missing = std::any_of(frame.records.begin(), frame.records.end(), [](float x) { return std::isnan(x); });
  frame.first_sample = std::move(samples.first_sample);
  result.facts.max_samples_per_pixel = most_samples(frame.first_sample);
  if (settings.method == Method::cross_bilateral)
    result.facts.feature_spread = spread_of_features(frame, result.facts.variables);
  return result;
}

}  // namespace rpf
