#include "opencl/row_pipeline.h"

#include <algorithm>

namespace rpf {

int RowPipeline::add_grid(int height) {
  grids_.push_back({height, 0, 1});
  return static_cast<int>(grids_.size()) - 1;
}

int RowPipeline::add_step(const std::vector<int>& grids, const std::vector<Read>& reads, int block) {
  const int number = static_cast<int>(steps_.size());
  for (const int grid : grids) grids_[index(grid)].step = number;
  Step step;
  step.grids = grids;
  step.reads = reads;
  step.block = std::max(block, 1);
  steps_.push_back(step);
  return number;
}

int RowPipeline::first_read(const Read& read, int first) {
  const int row = std::max(first - read.above, 0);
  return read.octave > 0 ? row * 2 : read.octave < 0 ? row / 2 : row;
}

int RowPipeline::end_read(const Read& read, int end) const {
  const int last = end - 1 + read.below;
  const int row = read.octave > 0 ? last * 2 + 1 : read.octave < 0 ? last / 2 : last;
  return std::min(row + 1, grids_[index(read.grid)].height);
}

void RowPipeline::start_at(int step, int first) {
  if (first >= steps_[index(step)].first) return;
  steps_[index(step)].first = first;
  for (const Read& read : steps_[index(step)].reads) start_at(grids_[index(read.grid)].step, first_read(read, first));
}

void RowPipeline::plan(int grid, int first, int end, bool keep_all) {
  for (Step& step : steps_) step.first = grids_[index(step.grids.front())].height;
  start_at(grids_[index(grid)].step, first);
  for (Step& step : steps_) {
    if (keep_all) step.first = 0;
    step.done = step.first;
  }
  for (Grid& g : grids_) g.rows = keep_all ? g.height : 1;
  wanted_ = grids_[index(grid)].step;
  wanted_end_ = end;
  advance(wanted_, end, {});
  for (Step& step : steps_) {
    step.end = step.done;
    step.done = step.first;
  }
}

void RowPipeline::keep_what_is_used(const Step& step, int next) {
  const auto keep = [&](int grid, int rows) { grids_[index(grid)].rows = std::max(grids_[index(grid)].rows, rows); };
  for (const int grid : step.grids) keep(grid, next - step.done);
  for (const Read& read : step.reads)
    keep(read.grid, steps_[index(grids_[index(read.grid)].step)].done - first_read(read, step.done));
}

void RowPipeline::advance(int number, int end, const Run& run) {
  Step& step = steps_[index(number)];
  while (step.done < end) {
    const int next = std::min(step.done + step.block, end);
    for (const Read& read : step.reads) advance(grids_[index(read.grid)].step, end_read(read, next), run);
    if (run)
      run(number, step.done, next);
    else
      keep_what_is_used(step, next);
    step.done = next;
  }
}

void RowPipeline::run(const Run& run) { advance(wanted_, wanted_end_, run); }

}  // namespace rpf
