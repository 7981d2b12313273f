#include "plan/tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tolerances.h"

namespace rpf {
namespace {

class OffsetTable : public testing::TestWithParam<int> {};

TEST_P(OffsetTable, IsTheTruncatedGaussianOfAQuarterBoxWidth) {
  const int box = GetParam(), reach = (box - 1) / 2;
  std::map<int, int> entries;
  for (const std::int8_t d : offset_table(box)) ++entries[d];
  double total = 0;
  const auto density = [&](int d) { return std::exp(-d * d / (2 * (box / 4.0) * (box / 4.0))); };
  for (int d = -reach; d <= reach; ++d) total += density(d);
  int sum = 0;
  for (int d = -reach; d <= reach; ++d) {
    const double expected = 65536 * density(d) / total;
    EXPECT_NEAR(entries[d], expected, d == 0 ? test::tolerance::center_entries : test::tolerance::offset_entries)
        << "offset " << d;
    EXPECT_EQ(entries[d], entries[-d]);
    sum += entries[d];
  }
  EXPECT_EQ(sum, 65536);
  EXPECT_EQ(entries.begin()->first, -reach);
}

INSTANTIATE_TEST_SUITE_P(BoxWidths, OffsetTable, testing::Values(1, 3, 5, 7, 17, 35, 55, 255));

TEST(EntropyTable, HoldsNLog2NModulo32Bits) {
  for (const std::uint32_t most : {4U, 28U, 1512U, 24200U, 1500000U}) {
    const EntropyTable table = entropy_table(most, 7);
    ASSERT_EQ(table.units.size(), most + 1U);
    EXPECT_EQ(table.units[0], 0);
    EXPECT_EQ(table.units[1], 0);
    for (std::uint32_t n = 2; n <= most; n += 1 + n / 50) {
      const long double exact = table.units_per_bit * (n * std::log2(static_cast<long double>(n)));
      const auto off =
          static_cast<std::int32_t>(static_cast<std::uint32_t>(table.units[n]) -
                                    static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(exact))));
      ASSERT_EQ(off, 0) << "n " << n << " of " << most;
    }
  }
}

TEST(EntropyTable, LeavesRoomForTheLargestSum) {
  for (const int bins : {3, 7, 31})
    for (const std::uint32_t most : {1U, 24U, 6050U, 24200U, 1U << 22}) {
      const int scale = entropy_table(most, bins).units_per_bit;
      const double largest = scale * (most * std::log2(bins)) + entropy_slack(bins);
      EXPECT_LT(largest, 2147483648.0);
      EXPECT_TRUE(scale == 1 << 24 || 2 * scale * (most * std::log2(bins)) + entropy_slack(bins) >= 2147483648.0);
    }
}

}  // namespace
}  // namespace rpf
