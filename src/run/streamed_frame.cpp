#include "run/streamed_frame.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "frame/clean.h"
#include "frame/resolve.h"
#include "learned/observe.h"
#include "parallel/thread_count.h"
#include "parallel/workers.h"
#include "run/row_scan.h"

namespace rpf {
namespace {

std::uint64_t block_bytes(const SampleRows& rows, int first, int end) {
  std::uint64_t bytes = 0;
  for (int row = first; row < end; ++row) bytes += rows.row_bytes(row);
  return bytes;
}

}  // namespace

StreamedFrame::StreamedFrame(SampleRows& rows, const ObservedFindings& found, const Settings& settings,
                             const EstimatePlan& plan, PreparedFrame& prepared, std::vector<SampleBuffer> kept,
                             std::uint64_t memory, std::uint64_t at_once)
    : rows_(rows),
      found_(found),
      settings_(settings),
      plan_(plan),
      prepared_(prepared),
      memory_(memory),
      means_(prepared, thread_count(settings)) {
  for (int first = 0; first < plan.height; first = blocks_.back().end) {
    Block block;
    block.first = first;
    block.end = rows.end_within(first, at_once);
    block.first_record =
        prepared.frame.first_sample[static_cast<std::size_t>(first) * static_cast<std::size_t>(plan.width)];
    blocks_.push_back(std::move(block));
  }
  for (SampleBuffer& part : kept) block_of(part.data_window.y - rows.frame().data_window.y).cleaned = std::move(part);
  make_room();
  prepared.frame.supply = this;
}

void StreamedFrame::Block::forget() {
  is_there = false;
  for (std::vector<float>* values : {&records, &weights, &others, &cleaned.values})
    std::vector<float>().swap(*values);  // assigning an empty one would keep the memory
}

std::uint64_t StreamedFrame::least_bytes(const SampleRows& rows) {
  std::uint64_t most = 0;
  for (int first = 0, end = 0; first < rows.frame().data_window.height; first = end) {
    end = rows.end_within(first, bytes_at_once);
    most = std::max(most, block_bytes(rows, first, end));
  }
  return 2 * most;  // what was read, and what is made of it
}

StreamedFrame::Block& StreamedFrame::block_of(int row) {
  const auto ends_before = [](const Block& block, int y) { return block.end <= y; };
  return *std::lower_bound(blocks_.begin(), blocks_.end(), row, ends_before);
}

int StreamedFrame::bring(int first, int end, bool again) {
  Block& block = block_of(first);
  block.latest_use = ++uses_;
  block.is_done = !again && block.end <= end;
  if (&block != current_) {
    if (current_ != nullptr) exchange_with_frame(*current_);
    current_ = nullptr;
    if (!block.is_there) read(block);
    exchange_with_frame(block);
    current_ = &block;
    add_means(block);
  }
  return std::min(block.end, end);
}

void StreamedFrame::exchange_with_frame(Block& block) {
  Frame& frame = prepared_.frame;
  std::swap(frame.records, block.records);
  std::swap(frame.weights, block.weights);
  std::swap(frame.others, block.others);
  frame.first_record = block.first_record;
}

/// Rows are asked for from the first on, and again from the first on. So those go that nobody will ask for, the one
/// used longest ago first, and then those that are asked for last.
void StreamedFrame::make_room() {
  const auto goes_before = [](const Block& a, const Block& b) {
    if (a.is_done != b.is_done) return a.is_done;
    return a.is_done ? a.latest_use < b.latest_use : a.first > b.first;
  };
  std::uint64_t kept = 0;
  for (const Block& block : blocks_) kept += block.bytes();
  while (kept > memory_) {
    Block* next = nullptr;
    for (Block& block : blocks_)
      if (block.bytes() > 0 && (next == nullptr || goes_before(block, *next))) next = &block;
    if (next == nullptr) return;
    kept -= next->bytes();
    next->forget();
  }
}

SampleBuffer StreamedFrame::cleaned_rows(Block& block) {
  if (!block.cleaned.values.empty()) return std::exchange(block.cleaned, {});
  make_room();
  SampleBuffer samples = rows_.read(block.first, block.end);
  clean_again(samples, find_columns(rows_.frame(), settings_.clamp_infinite), settings_);
  return samples;
}

void StreamedFrame::read(Block& block) {
  SampleBuffer samples = cleaned_rows(block);
  PreparedFrame part;
  part.frame.variables = prepared_.frame.variables;
  observe_rows(std::move(samples), rows_.frame(), found_, settings_, plan_, part);
  block.records = std::move(part.frame.records);
  block.weights = std::move(part.frame.weights);
  block.others = std::move(part.frame.others);
  block.is_there = true;
}

void StreamedFrame::add_means(const Block& block) {
  if (block.end <= counted_) return;
  counted_ = block.end;
  means_.add_rows(block.first, block.end);
  const Window& crop = prepared_.facts.crop;
  const int first = std::max(block.first, crop.y), end = std::max(std::min(block.end, crop.y + crop.height), first);
  std::vector<double> energies(static_cast<std::size_t>(end - first));
  Workers(thread_count(settings_)).for_all(0, energies.size(), [&](std::size_t n, std::size_t /*worker*/) {
    energies[n] = energy_of_means(prepared_.frame, {crop.x, first + static_cast<int>(n), crop.width, 1});
  });
  energy_ = std::accumulate(energies.begin(), energies.end(), energy_);
}

}  // namespace rpf
