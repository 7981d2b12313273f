// What the learned estimator has to know of all samples of a frame together (docs/network.md, "Frame facts"): found out
// rows after rows.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "frame/clean.h"
#include "frame/clean_frame.h"
#include "learned/record_view.h"

namespace rpf {

/// Of the positions of the first sample of every pixel that has one.
struct PositionFacts {
  double median[3] = {};  ///< lower median of each component
  double deviation = 1;   ///< mean absolute deviation from it, over the components too; 1 where all are one
};

/// Enough to observe any rows of the frame.
struct ObservedFindings {
  CleanReport cleaned;
  PositionFacts positions;
  float exposure = 1, weight_scale = 1;  ///< as in EstimatePlan
  bool has_hit = false;                  ///< whether any sample is of a hit
  std::vector<int> constant;             ///< inputs that there are channels for and that do not vary
  double energy = 0;  ///< sum of R, G and B of the means of the crop's pixels, weighted as the file says
};

class ObserveScan {
 public:
  /// `frame`: may be without its samples; outlives this.
  ObserveScan(const SampleBuffer& frame, const Settings& settings);

  /// Cleans the next rows and looks at them.
  void add(SampleBuffer& rows);
  /// After all rows: then some inputs can be told that depend on where the others lie. Returns whether any sample is
  /// left.
  bool finish();
  /// Whether there are inputs of which it is not known yet whether they vary. Then cleaned rows are to be looked at
  /// again, from the first on, until there are none or no rows are left; mostly the first rows are enough.
  bool must_look_again() const { return !relative_.empty(); }
  void look_again(const SampleBuffer& rows) { leave_constant(rows, relative_, first_relative_); }
  /// In the end.
  ObservedFindings findings();

 private:
  struct FirstValues {
    bool are_known = false;
    float values[RPF_INPUTS] = {};
  };
  using Marked = std::array<std::atomic<bool>, RPF_INPUTS>;

  /// The weighted energy of a pixel with the samples begin .. end - 1 of the rows.
  void include_weighted(const SampleBuffer& rows, std::size_t pixel, std::uint32_t begin, std::uint32_t end);
  void include_position(const SampleBuffer& rows, std::size_t pixel, std::uint32_t begin, std::uint32_t end);
  /// What these inputs are for the first sample of all, if these are the first rows.
  void know_first(const SampleBuffer& rows, const std::vector<int>& inputs, FirstValues& first) const;
  /// Leaves in `inputs` those that are for all samples what they are for the first of all.
  void leave_constant(const SampleBuffer& rows, std::vector<int>& inputs, FirstValues& first) const;
  /// Marks those of `inputs` that have another value in one of the samples begin .. end - 1; what others have marked is
  /// not looked at any more.
  void find_varying(const SampleBuffer& rows, std::size_t begin, std::size_t end, std::vector<int> inputs,
                    const FirstValues& first, Marked& varying) const;
  float exposure() const;
  double energy() const;

  Method method_;
  int threads_;
  CleanFrame clean_;
  Cleaning cleaning_;
  RecordView view_;
  std::vector<double> energies_;     ///< [pixel] R + G + B of its plain mean, in radiance as it is
  std::vector<double> weighted_;     ///< [pixel] the same of the weighted mean, where the file has weights
  std::vector<float> positions_[3];  ///< [pixel] of each component; NaN where there is none
  float largest_weight_ = 0;
  std::vector<int> plain_, relative_;  ///< inputs that did not vary so far; relative: to where the positions lie
  FirstValues first_plain_, first_relative_;
  ObservedFindings found_;
};

}  // namespace rpf
