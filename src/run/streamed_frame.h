// A frame for the learned estimator whose samples are read when they are needed, some rows at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/prepare.h"
#include "frame/row_supply.h"
#include "learned/estimate_plan.h"
#include "learned/observe_scan.h"
#include "rpf/rows.h"
#include "rpf/settings.h"
#include "run/plain_means.h"

namespace rpf {

class StreamedFrame : public RowSupply {
 public:
  /// All of these outlive this, which fills `prepared`; its first_sample is known. `kept`: rows that were cleaned while
  /// the frame was gone through by the same `at_once`. `memory`: bytes that may be kept for when they are asked for
  /// (again).
  StreamedFrame(SampleRows& rows, const ObservedFindings& found, const Settings& settings, const EstimatePlan& plan,
                PreparedFrame& prepared, std::vector<SampleBuffer> kept, std::uint64_t memory, std::uint64_t at_once);

  int bring(int first, int end, bool again) override;

  /// Of the rows that were brought: all of them, from the first on.
  const PlainMeans& means() const { return means_; }
  /// The same: energy_of_means() in the crop.
  double energy() const { return energy_; }

  /// Bytes of records that are in memory at most, whatever is kept: of the rows asked for, while they are read.
  static std::uint64_t least_bytes(const SampleRows& rows);

 private:
  /// Rows that are read at once, and what is kept of them.
  struct Block {
    int first = 0, end = 0;
    std::size_t first_record = 0;
    std::vector<float> records, weights, others;
    SampleBuffer cleaned;  ///< what these will be made of, where it was kept
    std::uint64_t latest_use = 0;
    bool is_there = false;  ///< records are, of which there may be none
    bool is_done = false;   ///< nobody will ask for it again

    std::uint64_t bytes() const {
      return (records.size() + weights.size() + others.size() + cleaned.values.capacity()) * sizeof(float);
    }
    void forget();
  };

  Block& block_of(int row);
  void exchange_with_frame(Block& block);
  void make_room();
  SampleBuffer cleaned_rows(Block& block);
  void read(Block& block);
  void add_means(const Block& block);

  SampleRows& rows_;
  const ObservedFindings& found_;
  const Settings& settings_;
  const EstimatePlan& plan_;
  PreparedFrame& prepared_;
  std::uint64_t memory_;
  std::vector<Block> blocks_;
  Block* current_ = nullptr;  ///< whose values are in the frame
  std::uint64_t uses_ = 0;
  int counted_ = 0;  ///< end of the rows whose means are known
  PlainMeans means_;
  double energy_ = 0;
};

}  // namespace rpf
