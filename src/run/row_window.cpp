#include "run/row_window.h"

#include <algorithm>
#include <utility>

#include "frame/clean.h"
#include "run/informative.h"

namespace rpf {
namespace {

void append_values(std::vector<float>& to, const std::vector<float>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

void forget_values(std::vector<float>& values, std::size_t count) {
  if (!values.empty()) values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

PreparedFrame prepare_again(SampleBuffer rows, const SampleBuffer& frame, const FrameFindings& found,
                            const Settings& settings) {
  clean_again(rows, find_columns(frame, settings.clamp_infinite), settings);
  PreparedFrame prepared = prepare_rows(std::move(rows), frame, found, settings);
  drop_channels(prepared, found.uninformative);
  return prepared;
}

PreparedFrame prepare_without_samples(const SampleBuffer& frame, const FrameFindings& found, const Settings& settings) {
  SampleBuffer none = frame;
  none.data_window.height = 0;
  none.first_sample = {0};
  PreparedFrame prepared = prepare_again(std::move(none), frame, found, settings);
  prepared.frame.has_missing = true;  // what rows hold that were not read is not known
  return prepared;
}

RowWindow::RowWindow(SampleRows& rows, const FrameFindings& found, const Settings& settings, PreparedFrame& prepared,
                     std::size_t passes, std::uint64_t samples)
    : rows_(rows), found_(found), settings_(settings), prepared_(prepared), colors_(std::max<std::size_t>(passes, 1)) {
  prepared.frame.records.reserve(samples * prepared.frame.variables);
  for (std::vector<float>& colors : colors_) colors.reserve(samples * prepared.facts.carried);
}

std::uint32_t& RowWindow::first_sample_of_row(int row) {
  return prepared_.frame.first_sample[static_cast<std::size_t>(row) * static_cast<std::size_t>(prepared_.frame.width)];
}

void RowWindow::move_to(const PassStep& step) {
  forget_before(step.rows.first);
  append(prepare_again(rows_.read(step.read_from, step.rows.end), rows_.frame(), found_, settings_), step.read_from);
}

void RowWindow::forget_before(int row) {
  Frame& frame = prepared_.frame;
  const std::uint32_t samples = first_sample_of_row(row);
  forget_values(frame.records, samples * frame.variables);
  forget_values(frame.weights, samples);
  for (std::vector<float>& colors : colors_) forget_values(colors, samples * prepared_.facts.carried);
  for (std::uint32_t& first : frame.first_sample) first = std::max(first, samples) - samples;
}

void RowWindow::append(const PreparedFrame& part, int first_row) {
  Frame& frame = prepared_.frame;
  const std::uint32_t before = frame.first_sample.back();
  append_values(frame.records, part.frame.records);
  append_values(frame.weights, part.frame.weights);
  append_values(colors_.front(), part.colors);
  for (std::size_t pass = 1; pass < colors_.size(); ++pass) colors_[pass].resize(colors_.front().size());
  const std::vector<std::uint32_t>& more = part.frame.first_sample;
  const std::size_t first_pixel = static_cast<std::size_t>(first_row) * static_cast<std::size_t>(frame.width);
  for (std::size_t pixel = first_pixel; pixel < more.size(); ++pixel) frame.first_sample[pixel] = before + more[pixel];
}

void RowWindow::take(const std::vector<float>& made, const RowRange& rows, std::size_t next_pass) {
  if (next_pass == colors_.size()) return;
  const std::size_t carried = prepared_.facts.carried;
  const auto first = static_cast<std::ptrdiff_t>(first_sample_of_row(rows.first) * carried);
  const auto end = static_cast<std::ptrdiff_t>(first_sample_of_row(rows.end) * carried);
  std::copy(made.begin() + first, made.begin() + end, colors_[next_pass].begin() + first);
}

}  // namespace rpf
