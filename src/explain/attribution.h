// Which group of random parameters makes a pixel noisy (docs/explain.md has the derivation).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frame.h"

namespace rpf {

/// The components of a group of random parameters: columns of a record.
struct RandomGroup {
  std::string name;                  ///< "lens"
  std::vector<std::size_t> columns;  ///< of lens.U and lens.V
};

/// In the order of the frame's variables.
std::vector<RandomGroup> random_groups(const Variables& variables);

/// Variances are those of one sample, summed over R, G and B, as means over the pixels around; scaled radiance squared
/// times a constant.
struct Attribution {
  std::vector<float> variance;  ///< [pixel] of a sample around its pixel's expectation
  std::vector<std::vector<float>>
      caused;  ///< [group][pixel] of what the group alone decides; 0 where it is not evident

  /// The group's part of what all groups cause; 0 where none causes anything.
  float share(std::size_t group, std::size_t pixel) const;
  /// The part of the variance that the groups cause one by one, 0 .. 1.
  float explained(std::size_t pixel) const;
};

Attribution attribute_noise(const Frame& frame, const std::vector<RandomGroup>& groups);

/// Peak bytes of attribute_noise().
std::uint64_t attribution_bytes(std::uint64_t pixels, std::size_t groups);

}  // namespace rpf
