// Values of two backends against each other, stage by stage.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rpf/conformance.h"
#include "seam/backend.h"

namespace rpf {

/// Units in the last place between two floats: 0 for the same bits and for two NaNs; +0 and -0 are 1 apart.
std::uint64_t ulp_distance(float a, float b);

/// Collects what differs in one case. Stages appear in the order in which they are first compared.
class Comparison {
 public:
  /// Where the values that follow come from, for the text of a difference.
  void at(int pass, std::string place);
  void values(const std::string& stage, const std::vector<float>& reference, const std::vector<float>& device);
  void counts(const std::string& stage, const std::vector<std::uint32_t>& reference,
              const std::vector<std::uint32_t>& device);
  /// All stages of a pixel's trace.
  void traces(const PixelTrace& reference, const PixelTrace& device);
  void statistics(const std::vector<PixelStatistics>& reference, const std::vector<PixelStatistics>& device);

  const std::vector<StageResult>& stages() const { return stages_; }
  const std::string& first_difference() const { return first_difference_; }

 private:
  template <typename T>
  void compare(const std::string& stage, const std::vector<T>& reference, const std::vector<T>& device);
  StageResult& stage(const std::string& name);

  std::vector<StageResult> stages_;
  std::string first_difference_, place_;
  int pass_ = 0;
};

}  // namespace rpf
