// Every tolerance of the C++ tests, with its reason. What is not listed is compared exactly.
// (tests/oracle/tolerances of the Python comparison: see tests/oracle/compare.py.)
#pragma once

namespace rpf::test::tolerance {

/// rpf_exp against long double. Measured over all floats: 0.982; 1 is the promise of kernels/numeric.h.
constexpr double exp_ulps = 1.0;

/// Entries of the offset table per offset against the exact Gaussian: each side is rounded to whole entries.
constexpr double offset_entries = 0.5;
/// ... and the center takes up what rounding left over on both sides, half an entry for each of up to 254 offsets.
constexpr double center_entries = 127.0;

/// Mutual information of small exact cases: the table's slack at N = 64 and S = 2^22 is 33 ln 2 / (2^22 * 64) = 9e-8,
/// one float rounding of a value near 2 adds 1.2e-7.
constexpr double information = 3e-7;

/// A formula of a few float operations against the same in double: some roundings of 6e-8 each.
constexpr double formula = 1e-6;

/// The outlier step gives back the energy it took: relative error of one float mean and one addition a sample.
constexpr double outlier_energy = 1e-6;

/// Polish in float against double, as part of the range of the values: exponents near 1 that are off by some
/// 1e-7 of themselves change weights by as much. Measured on noise: 8e-8.
constexpr double polish = 5e-7;

/// The sum of a pixel's float mean against a double mean.
constexpr double pixel_mean = 1e-6;

/// FLIP of black and white against the published colors of green and blue, which have four decimals.
constexpr double flip = 1e-5;
/// FLIP and HDR-FLIP in double against flip-evaluator in float; measured: at most 4.3e-7.
constexpr double flip_in_single_precision = 2e-6;

/// HDR-FLIP of light in another unit: exposures near 10 stops are rounded to 2^-50, and FLIP has slopes below 1000.
constexpr double exposure_rounding = 1e-11;

}  // namespace rpf::test::tolerance
