// Which rows of the estimator's grids are made when, so that few of them have to be kept.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace rpf {

/// Steps that make rows of grids from rows of other grids, in blocks, no earlier than they are asked for. A grid keeps
/// as many rows as its readers are behind it: found by going through all steps once without doing anything.
class RowPipeline {
 public:
  /// What a step reads of a grid for its rows first .. end - 1: so many more above and below, and of a grid that is
  /// finer by a level (octave 1) two rows a row, of a coarser one (-1) a row for two. Rows outside the grid are not
  /// read.
  struct Read {
    int grid = 0, above = 0, below = 0, octave = 0;
  };

  /// A grid of so many rows. Returns its number, 0, 1 ...
  int add_grid(int height);
  /// A step that makes `grids` (of one height), at most `block` rows at once; whoever makes what it reads is already
  /// there. Returns its number, 0, 1 ...
  int add_step(const std::vector<int>& grids, const std::vector<Read>& reads, int block);

  /// Finds what is needed for rows first .. end - 1 of a grid. `keep_all`: grids are kept whole.
  void plan(int grid, int first, int end, bool keep_all);
  /// Rows of a grid that have to be kept at once, and rows that a step makes in all; after plan().
  int rows(int grid) const { return grids_[index(grid)].rows; }
  int made(int step) const { return steps_[index(step)].end - steps_[index(step)].first; }

  /// Does what was planned: calls run(step, first, end) for rows in turn.
  using Run = std::function<void(int step, int first, int end)>;
  void run(const Run& run);

 private:
  struct Grid {
    int height = 0, step = 0, rows = 1;
  };
  struct Step {
    std::vector<int> grids;
    std::vector<Read> reads;
    int block = 1, first = 0, done = 0, end = 0;
  };

  static std::size_t index(int number) { return static_cast<std::size_t>(number); }
  static int first_read(const Read& read, int first);
  int end_read(const Read& read, int end) const;
  void start_at(int step, int first);
  /// Makes the rows of a step before `end` that are not there yet.
  void advance(int step, int end, const Run& run);
  void keep_what_is_used(const Step& step, int next);

  std::vector<Grid> grids_;
  std::vector<Step> steps_;
  int wanted_ = 0, wanted_end_ = 0;
};

}  // namespace rpf
