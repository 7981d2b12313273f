// The rows of a frame that passes read, and no others, in memory.
#pragma once

#include <vector>

#include "frame/frame_scan.h"
#include "frame/prepare.h"
#include "rpf/rows.h"
#include "run/pass_steps.h"

namespace rpf {

/// Makes the samples of a prepared frame be those of a few rows, which move down the frame; all other pixels are as
/// without samples. Along go the samples' colors as each pass finds them.
class RowWindow {
 public:
  /// Room for `samples` at once is taken here, so that no step takes more. All that is referred to outlives this.
  RowWindow(SampleRows& rows, const FrameFindings& found, const Settings& settings, PreparedFrame& prepared,
            std::size_t passes, std::uint64_t samples);

  /// Reads the rows of a step, prepared, and forgets those that it does not need. Throws Error(input).
  void move_to(const PassStep& step);
  /// c' of a pass, [sample][carried]: of the rows that the passes before it have filtered.
  const std::vector<float>& colors(std::size_t pass) const { return colors_[pass]; }
  /// Takes over what a pass made of some rows: c' of the next one.
  void take(const std::vector<float>& made, const RowRange& rows, std::size_t next_pass);

 private:
  std::uint32_t& first_sample_of_row(int row);
  void forget_before(int row);
  void append(const PreparedFrame& part, int first_row);

  SampleRows& rows_;
  const FrameFindings& found_;
  const Settings& settings_;
  PreparedFrame& prepared_;
  std::vector<std::vector<float>> colors_;  ///< [pass]; of the first one at least
};

/// Some rows that were read, prepared with what was found in the whole frame.
PreparedFrame prepare_again(SampleBuffer rows, const SampleBuffer& frame, const FrameFindings& found,
                            const Settings& settings);

/// What is known of a frame before its samples are.
PreparedFrame prepare_without_samples(const SampleBuffer& frame, const FrameFindings& found, const Settings& settings);

}  // namespace rpf
