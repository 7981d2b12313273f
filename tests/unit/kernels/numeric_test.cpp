// kernels/numeric.h: the numeric contract.
#include "numeric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tolerances.h"

namespace rpf::kernel {
namespace {

/// Distance of a float from the true value in units of the true value's last place.
double ulps(float value, long double truth) {
  const float rounded = static_cast<float>(truth);
  const float unit = std::nextafter(rounded, std::numeric_limits<float>::infinity()) - rounded;
  return static_cast<double>(std::fabs(value - truth) / unit);
}

TEST(Exp, StaysWithinOneUlpOfLongDouble) {
  // Every 101st float from -0 to the underflow; all 1.1e9 of them were checked once: 0.982 ULP.
  const std::uint32_t last = 0xC2AE0000U;  // -87
  for (std::uint32_t bits = 0x80000000U; bits <= last; bits += 101) {
    const float x = as_float(static_cast<int>(bits));
    ASSERT_LE(ulps(rpf_exp(x), std::exp(static_cast<long double>(x))), test::tolerance::exp_ulps) << "x = " << x;
  }
}

TEST(Exp, IsExactlyOneAtZeroAndZeroBelowTheUnderflow) {
  EXPECT_EQ(rpf_exp(0.0F), 1.0F);
  EXPECT_EQ(rpf_exp(-0.0F), 1.0F);
  EXPECT_GE(rpf_exp(-87.0F), std::numeric_limits<float>::min());
  for (const float x : {-87.1F, -104.0F, -1e30F, -std::numeric_limits<float>::infinity()})
    EXPECT_EQ(rpf_exp(x), 0.0F) << x;
}

TEST(Lanes, TotalIsTheFixedTree) {
  rpf_lanes lanes;
  rpf_lanes_clear(&lanes);
  // 2^24 + 1 is not a float: the result tells in which order the parts were added.
  rpf_lanes_add(&lanes, 0, 16777216.0F);
  rpf_lanes_add(&lanes, 1, 1.0F);
  rpf_lanes_add(&lanes, 9, 1.0F);
  EXPECT_EQ(rpf_lanes_total(&lanes), 16777218.0F);  // (1 + 1) first, then the large one
  rpf_lanes_clear(&lanes);
  rpf_lanes_add(&lanes, 0, 16777216.0F);
  rpf_lanes_add(&lanes, 8, 1.0F);
  rpf_lanes_add(&lanes, 4, 1.0F);
  EXPECT_EQ(rpf_lanes_total(&lanes), 16777216.0F);  // 0 + 8 loses the one, then 0 + 4 too
}

TEST(Lanes, ElementBelongsToItsLaneModuloSixteen) {
  rpf_lanes lanes;
  rpf_lanes_clear(&lanes);
  for (uint j = 0; j < 100; ++j) rpf_lanes_add(&lanes, j, static_cast<float>(j));
  EXPECT_EQ(lanes.lane[3], 3 + 19 + 35 + 51 + 67 + 83 + 99);
  EXPECT_EQ(rpf_lanes_total(&lanes), 4950.0F);
}

TEST(Hash, IsThePublishedPcg3d) {
  // Computed with unbounded integers in Python from the listing in Jarzynski and Olano, JCGT 9(3), 2020.
  const rpf_words a = rpf_hash(0, 0, 0), b = rpf_hash(1, 2, 3);
  EXPECT_EQ(a.x, 2611992518U);
  EXPECT_EQ(a.y, 2833812075U);
  EXPECT_EQ(a.z, 1058359340U);
  EXPECT_EQ(b.x, 4204755366U);
  EXPECT_EQ(b.y, 1223881804U);
  EXPECT_EQ(b.z, 1500469937U);
}

TEST(MulHi, IsTheUpperHalfOfTheProduct) {
  EXPECT_EQ(mul_hi(0xFFFFFFFFU, 0xFFFFFFFFU), 0xFFFFFFFEU);
  EXPECT_EQ(mul_hi(0x80000000U, 7U), 3U);
}

}  // namespace
}  // namespace rpf::kernel
