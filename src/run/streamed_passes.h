// Passes over a frame whose rows are read when they are needed, each of them once.
#pragma once

#include <memory>
#include <vector>

#include "rpf/rows.h"
#include "run/pass_summary.h"
#include "run/picture.h"
#include "run/progress_meter.h"
#include "run/row_window.h"

namespace rpf {

/// Every pass trails the one before by what it reads around itself, so that few rows of each are in memory.
class StreamedPasses {
 public:
  /// `prepared`: prepare_without_samples(); `plan`: of its facts. At most `at_once` bytes of rows, or one row, are read
  /// at a time. All that is referred to outlives this.
  StreamedPasses(SampleRows& rows, const FrameFindings& found, const Settings& settings, const Plan& plan,
                 PreparedFrame& prepared, std::uint64_t at_once);

  /// Runs all passes. Throws as filter() does.
  void run(std::unique_ptr<Backend>& backend, const Control& control, ProgressMeter& meter);
  /// After it: what was filtered, and what is told of each pass.
  const Pixels& pixels() const { return pixels_; }
  std::vector<PassReport> reports() const;

 private:
  /// What is told of a pass, as far as it is.
  struct Told {
    PassSummary summary;
    double energy = 0, seconds = 0;
  };

  void read(const PassStep& step);
  void filter(std::size_t pass, const RowRange& rows, std::unique_ptr<Backend>& backend, const Control& control,
              ProgressMeter& meter);
  void load(std::vector<float> colors, std::unique_ptr<Backend>& backend, ProgressMeter& meter);
  /// The pixels of some rows; kept where they are the result.
  Pixels resolved(const RowRange& rows, const std::vector<float>& colors, bool is_result);

  const Settings& settings_;
  const Plan& plan_;
  PreparedFrame& prepared_;
  std::vector<PassStep> steps_;
  RowWindow window_;
  bool is_loaded_ = false;
  double plain_energy_ = 0;
  std::vector<Told> told_;  ///< [pass]
  Pixels pixels_;
};

}  // namespace rpf
