#include "frame/clean_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/outputs.h"

namespace rpf {
namespace {

/// The brightest value of the frame is brought to [2^40, 2^41): squares and sums of millions of them stay finite, and
/// values 2^-166 times as bright are still normal numbers.
constexpr int brightest_exponent = 40;

/// What is averaged beside the color: alpha where the file has it, all features where they are wanted.
std::vector<std::size_t> carried_columns(const SampleLayout& layout, const Columns& columns, const Settings& settings,
                                         std::vector<std::string>& names) {
  std::vector<std::size_t> carried;
  names = {"R", "G", "B"};
  if (columns.alpha) {
    carried.push_back(*columns.alpha);
    names.emplace_back("A");
  }
  for (std::size_t c = 0; settings.filter_features && c < layout.size(); ++c) {
    if (!is_feature_slot(layout.slots[c])) continue;
    carried.push_back(c);
    names.push_back(short_name(layout.slots[c]));
  }
  return carried;
}

std::vector<float> sample_weights(const SampleBuffer& samples, const Columns& columns) {
  std::vector<float> weights;
  for (std::size_t i = 0; columns.weight && i < samples.sample_count(); ++i)
    weights.push_back(samples.record(i)[*columns.weight]);
  return weights;
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

std::string short_name(const std::string& slot) {
  return is_random_slot(slot) || is_feature_slot(slot) ? slot.substr(slot.find('.') + 1) : slot;
}

std::vector<float> carried_values(const CleanFrame& clean, bool with_color) {
  const float scale = clean.prepared.facts.radiance_scale;
  const std::size_t count = clean.samples.sample_count(), width = clean.carried.size() + (with_color ? 3 : 0);
  std::vector<float> values;
  values.reserve(count * width);
  for (std::size_t i = 0; width > 0 && i < count; ++i) {
    const float* record = clean.samples.record(i);
    for (std::size_t k = 0; with_color && k < 3; ++k) values.push_back(record[clean.columns.color[k]] * scale);
    for (const std::size_t c : clean.carried) values.push_back(std::isnan(record[c]) ? 0.0F : record[c]);
  }
  return values;
}

float power_of_two(int exponent) { return std::ldexp(1.0F, std::clamp(exponent, -126, 126)); }

float radiance_scale(float brightest) {
  return brightest > 0 ? power_of_two(brightest_exponent - std::ilogb(brightest)) : 1.0F;
}

SampleBuffer without_samples(const SampleBuffer& samples) {
  SampleBuffer frame;
  frame.data_window = samples.data_window;
  frame.display_window = samples.display_window;
  frame.layout = samples.layout;
  frame.metadata = samples.metadata;
  frame.half_slots = samples.half_slots;
  return frame;
}

CleanFrame begin_frame(const SampleBuffer& frame, const Settings& settings) {
  CleanFrame clean;
  PreparedFrame& prepared = clean.prepared;
  clean.frame = without_samples(frame);
  clean.columns = find_columns(frame, settings.clamp_infinite);
  clean.selection = select_channels(frame.layout, settings);
  clean.carried = carried_columns(frame.layout, clean.columns, settings, prepared.carried_names);
  prepared.facts.crop = wanted_region(frame.data_window, settings.crop);
  prepared.facts.carried = prepared.carried_names.size();
  prepared.frame.width = prepared.facts.width = frame.data_window.width;
  prepared.frame.height = prepared.facts.height = frame.data_window.height;
  return clean;
}

void center_missing_positions(SampleBuffer& rows, const Columns& columns, Method method) {
  if (method == Method::rpf) return;
  const Window& w = rows.data_window;
  for (std::size_t pixel = 0; pixel < w.pixel_count(); ++pixel)
    for (std::uint32_t i = rows.first_sample[pixel]; i < rows.first_sample[pixel + 1]; ++i) {
      const int place[2] = {w.x + static_cast<int>(pixel) % w.width, w.y + static_cast<int>(pixel) / w.width};
      for (int axis = 0; axis < 2; ++axis) {
        float& value = rows.record(i)[columns.film[axis]];
        if (std::isnan(value)) value = static_cast<float>(place[axis]) + 0.5F;
      }
    }
}

void take_report(CleanFrame& clean, const CleanReport& report) {
  clean.prepared.notes = report.notes;
  clean.prepared.facts.radiance_scale = radiance_scale(report.brightest);
  clean.prepared.facts.max_samples_per_pixel = report.most_samples;
}

void take_rows(CleanFrame& clean, SampleBuffer rows, const CleanReport& report, Method method) {
  fill_lost(rows, clean.frame.data_window, clean.columns, report);
  if (report.lacks_positions) center_missing_positions(rows, clean.columns, method);
  clean.prepared.frame.weights = sample_weights(rows, clean.columns);
  clean.samples = std::move(rows);
}

std::vector<std::uint32_t> first_sample_in_frame(std::vector<std::uint32_t> of_rows, const Window& rows,
                                                 const Window& data_window) {
  if (rows == data_window) return of_rows;
  std::vector<std::uint32_t> all(data_window.pixel_count() + 1, of_rows.back());
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first_pixel(rows, data_window));
  std::fill(all.begin(), begin, 0U);
  std::copy(of_rows.begin(), of_rows.end(), begin);
  return all;
}

}  // namespace rpf
