// Tables that the host builds once in double precision, so that no backend evaluates a logarithm or a Gaussian.
#pragma once

#include <cstdint>
#include <vector>

namespace rpf {

/// Offsets along one axis (algorithm.md, section 3): entry u of 65,536 is the offset that the 16-bit random number u
/// stands for. A discretized Gaussian of standard deviation box_width / 4, cut at (box_width - 1) / 2; exactly
/// symmetric.
std::vector<std::int8_t> offset_table(int box_width);

/// The table behind mutual information (algorithm.md, section 5).
struct EntropyTable {
  int units_per_bit = 1;            ///< S, a power of two
  std::vector<std::int32_t> units;  ///< [n]: round(S n log2 n) modulo 2^32. Sums of entries are right modulo 2^32.
};

/// A table for neighborhoods of up to max_neighbors samples and `bins` bins. S is the largest power of two, at most
/// 2^24, for which every possible sum N I S stays below 2^31.
EntropyTable entropy_table(std::uint32_t max_neighbors, int bins);

/// The largest rounding error of such a sum, in units: half a unit for each of B^2 + 2B + 1 entries, rounded up.
int entropy_slack(int bins);

}  // namespace rpf
