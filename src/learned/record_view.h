// Inputs of the network from the records of a prepared frame (docs/network.md, "Inputs of a sample").
#pragma once

#include <array>
#include <optional>
#include <string>

#include "frame/frame.h"
#include "frame/variables.h"
#include "rpf_network.h"

namespace rpf {

struct PositionFacts;

class RecordView {
 public:
  explicit RecordView(const Variables& variables);

  /// Whether the frame has what this input, from RPF_INPUT_NORMAL on, is made of.
  bool has(int input) const;
  bool has_position(const float* record) const;
  float position(const float* record, std::size_t component) const { return record[(*position_)[component]]; }
  bool any_hit(const Frame& frame) const;
  /// The inputs from RPF_INPUT_NORMAL on that there are; the others are left as they are.
  void read(const float* record, const PositionFacts& positions, float* inputs) const;

 private:
  using Columns = std::optional<std::array<std::size_t, 3>>;  ///< of a group, where all three are there

  bool is_hit(const float* record) const;
  bool is_second_hit(const float* record) const;
  void read_first_hit(const float* record, const PositionFacts& positions, float* inputs) const;
  void read_second_hit(const float* record, const PositionFacts& positions, float* inputs) const;

  Columns normal_, albedo_, position_, normal2_, position2_;
  std::optional<std::size_t> hit_;
  std::optional<std::size_t> random_[RPF_INPUTS];  ///< [input] of random parameters
};

/// The input that a variable such as "N.X", "lens.U" or "hit" goes into; of those that go into several the first. -1:
/// none.
int input_of(const std::string& variable);

}  // namespace rpf
