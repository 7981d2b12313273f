// Which group of random parameters makes a pixel noisy (docs/explain.md has the derivation).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "frame/variables.h"

namespace rpf {

/// The brightest value of the frame, 2^40 (prepare.cpp), becomes 2^20 for sums of fourth powers.
constexpr float attribution_unit = 0x1p-20F;
/// Statistics are means over the pixels around, weighted by a Gaussian of this standard deviation, pixels: what the
/// lens does differs from pixel to pixel, how much it does hardly.
constexpr float attribution_sigma = 2;

/// The components of a group of random parameters: columns of a record.
struct RandomGroup {
  std::string name;                  ///< "lens"
  std::vector<std::size_t> columns;  ///< of lens.U and lens.V
};

/// In the order of the frame's variables.
std::vector<RandomGroup> random_groups(const Variables& variables);

/// Variances are those of one sample, summed over R, G and B, as means over the pixels around; scaled radiance times
/// attribution_unit, squared.
struct Attribution {
  std::vector<float> variance;  ///< [pixel] of a sample around its pixel's expectation
  std::vector<std::vector<float>>
      caused;  ///< [group][pixel] of what the group alone decides; 0 where it is not evident

  /// The group's part of what all groups cause; 0 where none causes anything.
  float share(std::size_t group, std::size_t pixel) const;
  /// The part of the variance that the groups cause one by one, 0 .. 1.
  float explained(std::size_t pixel) const;
};

/// `after_rows` is called after some rows of pixels each, and may throw.
Attribution attribute_noise(const Frame& frame, const std::vector<RandomGroup>& groups, int threads,
                            const std::function<void()>& after_rows);

/// Peak bytes of attribute_noise().
std::uint64_t attribution_bytes(std::uint64_t pixels, std::size_t groups);

}  // namespace rpf
