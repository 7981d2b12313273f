// Frames of which not all samples are in memory.
#pragma once

namespace rpf {

/// Brings rows of a frame into memory as they are asked for.
class RowSupply {
 public:
  RowSupply() = default;
  virtual ~RowSupply() = default;
  RowSupply(const RowSupply&) = delete;
  RowSupply& operator=(const RowSupply&) = delete;

  /// Makes the frame's records, weights and what is carried be those of row `first` and of rows behind it; those of all
  /// others are gone. `again`: whether these rows will be asked for once more. Returns the end of the rows that are
  /// there, at most `end`. Throws Error(input).
  virtual int bring(int first, int end, bool again) = 0;
};

}  // namespace rpf
