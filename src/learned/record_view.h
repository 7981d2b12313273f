// Inputs of the network from the records of a cleaned frame (docs/network.md, "Inputs of a sample").
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frame/clean_frame.h"
#include "frame/column_block.h"
#include "rpf_network.h"

namespace rpf {

struct Network;
struct PositionFacts;

/// Inputs of some samples, input by input.
struct InputBlock {
  float values[RPF_INPUTS][block_records];
};

class RecordView {
 public:
  /// Of the channels that the settings select.
  explicit RecordView(const CleanFrame& clean);

  /// Whether the frame has what this input, from RPF_INPUT_NORMAL on, is made of.
  bool has(int input) const;
  bool has_position(const float* record) const;
  float position(const float* record, std::size_t component) const { return record[(*position_)[component]]; }
  bool any_hit(const SampleBuffer& samples) const;
  /// The same, that reads no other inputs than these, or others of their groups.
  RecordView only(const std::vector<int>& inputs) const;
  /// For read(): of the columns that the inputs are made of, and of others.
  ColumnBlock block(std::vector<std::size_t> others = {}) const;
  /// The inputs from RPF_INPUT_NORMAL on that there are; the others are left as they are.
  void read(const ColumnBlock& records, const PositionFacts& positions, InputBlock& inputs) const;

 private:
  using Columns = std::optional<std::array<std::size_t, 3>>;  ///< of a group, where all three are there

  /// An input that is a random number, or a position on the film less `origin`.
  struct Number {
    int input;
    std::size_t column;
    float origin;
    bool is_film;
  };

  /// The groups of inputs that are read; asked for every sample, so found once.
  struct Reads {
    bool normal = false, albedo = false, position = false, second_hit = false, second_distance = false;
  };

  Reads reads_of(const std::vector<int>& inputs) const;
  void read_all(const ColumnBlock& records, const PositionFacts& positions, InputBlock& inputs) const;
  bool is_hit(const float* record) const;
  void find_hits(const ColumnBlock& records, BlockMask& hits) const;
  void read_first_hits(const ColumnBlock& records, const BlockMask& hits, const PositionFacts& positions,
                       InputBlock& inputs) const;
  void read_second_hits(const ColumnBlock& records, const BlockMask& hits, const PositionFacts& positions,
                        InputBlock& inputs) const;
  void read_second_distances(const ColumnBlock& records, const BlockMask& again, const PositionFacts& positions,
                             float (&input)[block_records]) const;

  std::size_t stride_ = 0;  ///< values of a record
  Columns normal_, albedo_, position_, normal2_, position2_;
  std::optional<std::size_t> hit_;
  std::vector<Number> numbers_;
  Reads reads_;
};

/// The input that a variable such as "N.X", "lens.U" or "hit" goes into; of those that go into several the first. -1:
/// none.
int input_of(const std::string& variable);

/// Whether a network looks at what goes into an input: into one of the first 16, by which passes are guided or which
/// all estimates need, or into one that sample1 has a weight for. A normal of a second hit also says whether there is
/// one.
bool looks_at(const Network& network, int input);
/// The same of what is in a slot.
bool looks_at(const Network& network, const std::string& slot);

}  // namespace rpf
