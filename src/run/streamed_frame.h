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

namespace rpf {

class StreamedFrame : public RowSupply {
 public:
  /// All of these outlive this, which fills `prepared`; its first_sample is known. `memory`: bytes of records that may
  /// be kept for when they are asked for again. Reads rows of at most `at_once` bytes, or one row.
  StreamedFrame(SampleRows& rows, const ObservedFindings& found, const Settings& settings, const EstimatePlan& plan,
                PreparedFrame& prepared, std::uint64_t memory, std::uint64_t at_once);

  int bring(int first, int end, bool again) override;

  /// energy_of_means() over the crop, of the rows that were brought: all of them, from the first on.
  double plain_energy() const { return plain_energy_; }

  /// Bytes of records that are in memory at most, whatever is kept: of the rows asked for, while they are read.
  static std::uint64_t least_bytes(const SampleRows& rows);

 private:
  /// Rows that are read at once, and what is kept of them.
  struct Block {
    int first = 0, end = 0;
    std::size_t first_record = 0;
    std::vector<float> records, weights, others;
    std::uint64_t latest_use = 0;
    bool is_done = false;  ///< nobody will ask for it again

    std::uint64_t bytes() const { return (records.size() + weights.size() + others.size()) * sizeof(float); }
  };

  Block& block_of(int row);
  void exchange_with_frame(Block& block);
  void make_room();
  void read(Block& block);
  void add_energy(const Block& block);

  SampleRows& rows_;
  const ObservedFindings& found_;
  const Settings& settings_;
  const EstimatePlan& plan_;
  PreparedFrame& prepared_;
  std::uint64_t memory_;
  std::vector<Block> blocks_;
  Block* current_ = nullptr;  ///< whose values are in the frame
  std::uint64_t uses_ = 0;
  int counted_ = 0;  ///< end of the rows whose energy is known
  double plain_energy_ = 0;
};

}  // namespace rpf
