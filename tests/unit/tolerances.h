// Every tolerance of the C++ tests, with its reason. What is not listed is compared exactly.
// (tests/oracle/tolerances of the Python comparison: see tests/oracle/compare.py.)
#pragma once

namespace rpf::test::tolerance {

/// rpf_exp against long double. Measured over all floats: 0.982; 1 is the promise of kernels/numeric.h.
constexpr double exp_ulps = 1.0;

/// rpf_log against long double, relative to max(|ln x|, 1/4). Measured over every 101st normal float: 8.1e-8.
constexpr double log = 1e-7;

/// A 3x3 convolution of up to 40 inputs as a chain of 360 fma in float, against double; values near 1.
constexpr double convolution = 1e-5;

/// A color that is the same everywhere, after four passes of 25 weighted terms in float.
constexpr double estimated_constant = 2e-6;
/// Least and largest of what is averaged against the average: some hundred roundings of 6e-8, relative to the largest
/// magnitude within reach.
constexpr double estimated_bound = 2e-5;

/// A pixel of a network's picture against the mean of its samples by the shares that are told: shares are floats, and
/// the passes rounded each of four means of 25 once more.
constexpr double remade_pixel = 1e-5;

/// The estimated relMSE of 180 pixels of 4 uniform numbers, three colors each, relative: 540 variances of 3 degrees of
/// freedom deviate by 0.9 / sqrt(540) = 4 % together, their brightness by less. Three such deviations.
constexpr double estimated_error = 0.12;

/// Estimated over true squared error of a Gaussian of 5 pixels on 1,200 pixels of even noise, three colors: errors of
/// neighbors are alike, so that some 1,200 * 3 / 12 of them are independent, and halves have the same number. Three deviations
/// of sqrt(2 / 300 + 2 / 300).
constexpr double noise_of_halves = 0.35;

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

/// The sum of a pixel's float mean against a double mean.
constexpr double pixel_mean = 1e-6;

/// The same picture from an input that was rounded otherwise, relative. Weights and means are a few roundings of 6e-8
/// each, which the exponents of the weights, up to 87, amplify.
constexpr double picture = 1e-4;
/// Values of a picture of 384 pixels that may be further off where the input was rounded otherwise: a value on the edge
/// of a bin decides on a count. Measured: at most 1, on 14 scenes.
constexpr int rounded_values = 3;

/// Mean and standard deviation against double, as parts of the deviation: sums of some hundred float values that were
/// shifted by one of them.
constexpr double moment = 2e-6;
/// Filtered colors against double from the same normalized values, relative: weights have exponents of up to 87, which
/// are sums of some roundings of 6e-8 each.
constexpr double filtered = 1e-5;
/// Weighted mean of 24,200 values against double from the same weights: sums of 48 sums of
/// 32 values in each of 16 lanes. Measured: 3.1e-7 (8.2e-6 as plain sums of 1,512 values).
constexpr double long_sum = 1e-6;
/// Mean mutual information of independent variables against (B-1)^2 / (2N), relative: the next term of that series is
/// 9 % with 7 bins and N = 196 (numpy, 300 trials: 0.1004 for 0.0918).
constexpr double bias = 0.12;
/// ... and against a measured number of two digits, with 32 bins in place of 31.
constexpr double sparse_bias = 0.1;

/// FLIP of black and white against the published colors of green and blue, which have four decimals.
constexpr double flip = 1e-5;
/// FLIP and HDR-FLIP in double against flip-evaluator in float; measured: at most 4.3e-7.
constexpr double flip_in_single_precision = 2e-6;

/// HDR-FLIP of light in another unit: exposures near 10 stops are rounded to 2^-50, and FLIP has slopes below 1000.
constexpr double exposure_rounding = 1e-11;

/// Mean share of a group of random parameters in the noise of 96x54 pixels: what is subtracted for chance is some
/// percent of each share. Measured with 16 samples a pixel: at most 0.025.
constexpr double attributed_share = 0.04;
/// Mean part of independent noise that is attributed nevertheless. Measured: 0.006, and 0.029 where no standard error
/// is subtracted.
constexpr double attributed_to_chance = 0.015;
/// Mean standard deviation that is estimated on 96x54 pixels, relative: 20,736 coins determine theirs to 0.5 %.
constexpr double estimated_noise = 0.02;

/// Binomial probabilities through log-gamma, sums of at most ten of them, against their ten printed digits.
constexpr double binomial = 1e-9;

/// Slopes and means over a few hundred pixels of single precision between 0 and 40, in double; fractions of predicted
/// work, added up.
constexpr double study = 1e-5;

}  // namespace rpf::test::tolerance
