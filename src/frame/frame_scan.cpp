#include "frame/frame_scan.h"

#include <algorithm>
#include <cmath>

#include "rpf/methods.h"

namespace rpf {
namespace {

bool is_hit(const float* record, const Columns& columns) {
  if (columns.hit) return record[*columns.hit] != 0;
  const auto is_zero = [&](std::size_t c) { return record[c] == 0; };
  return columns.normal.empty() || !std::all_of(columns.normal.begin(), columns.normal.end(), is_zero);
}

}  // namespace

Source source_of(const SampleLayout& layout, const std::string& slot) {
  if (slot == "pixel.X") return {Source::fraction, *layout.find("film.X"), 0};
  if (slot == "pixel.Y") return {Source::fraction, *layout.find("film.Y"), 0};
  return {Source::plain, *layout.find(slot), 0};
}

float value_of(float value, const Source& source, float scale) {
  if (source.kind == Source::color) return value * scale;
  return source.kind == Source::fraction ? value - std::floor(value) : value - source.origin;
}

FrameScan::FrameScan(const SampleBuffer& frame, const Settings& settings)
    : clean_(begin_frame(frame, settings)),
      cleaning_(clean_.frame, clean_.columns, settings),
      low_(clean_.columns.position.size(), std::numeric_limits<double>::infinity()),
      high_(low_.size(), -std::numeric_limits<double>::infinity()) {
  for (const auto* slots : {&clean_.selection.random, &clean_.selection.features})
    for (const std::string& slot : *slots) channels_.push_back({slot, source_of(frame.layout, slot)});
  for (Channel& channel : channels_) channel.varies = keeps_constant_channels(settings.method);
}

void FrameScan::add(SampleBuffer& rows) {
  cleaning_.add(rows);
  for (Channel& channel : channels_) look_for_variation(rows, channel);
  include_positions(rows);
}

void FrameScan::look_for_variation(const SampleBuffer& rows, Channel& channel) const {
  for (std::size_t i = 0; i < rows.sample_count() && !channel.varies; ++i) {
    const float value = value_of(rows.record(i)[channel.source.column], channel.source, 1);
    if (std::isnan(channel.first)) channel.first = value;
    channel.varies = value < channel.first || value > channel.first;
  }
}

/// Missed rays left out.
void FrameScan::include_positions(const SampleBuffer& rows) {
  const std::vector<std::size_t>& position = clean_.columns.position;
  for (std::size_t i = 0; i < rows.sample_count() && !position.empty(); ++i) {
    const float* record = rows.record(i);
    const auto is_missing = [&](std::size_t c) { return std::isnan(record[c]); };
    if (!is_hit(record, clean_.columns) || std::any_of(position.begin(), position.end(), is_missing)) continue;
    for (std::size_t k = 0; k < low_.size(); ++k) {
      low_[k] = std::min<double>(low_[k], record[position[k]]);
      high_[k] = std::max<double>(high_[k], record[position[k]]);
    }
  }
}

FrameFindings FrameScan::findings() {
  FrameFindings found;
  found.cleaned = cleaning_.report();
  for (const Channel& channel : channels_)
    if (!channel.varies || !found.cleaned.has_color) found.constant.push_back(channel.slot);
  double square = 0;
  for (std::size_t k = 0; k < low_.size() && found.cleaned.has_color; ++k)
    square += high_[k] >= low_[k] ? (high_[k] - low_[k]) * (high_[k] - low_[k]) : 0;
  found.position_diagonal = static_cast<float>(std::sqrt(square));
  return found;
}

}  // namespace rpf
