// Arbitrary frames for properties, and what the properties compare.
// Every kind of frame (samples a pixel, channels, bins) is a kernel to compile: the kinds here are few on purpose.
#pragma once

#include <gtest/gtest.h>
// The header of RapidCheck wants that of GoogleTest before it.
#include <rapidcheck/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "test_frames.h"

namespace rpf::test {

/// 24 x 16 pixels of the defocused edge with any seed: 4 samples each, or varying from 0 to 5.
SampleBuffer any_frame();
/// The same, always with 4 samples a pixel.
SampleBuffer any_uniform_frame();

/// The backend under test, box widths 7 and 3, `profile` or any of the two, any seed of the draws.
Settings settings_of(Profile profile);
Settings any_settings();

/// How far a pixel can see in the passes of any_settings(): 3 + 1 pixels.
constexpr int reach = 4;

/// Any index of a sample of the frame.
std::uint32_t any_sample(const SampleBuffer& samples);
/// The pixel that a sample belongs to.
int pixel_of(const SampleBuffer& samples, std::uint32_t sample);

/// Any float that is not NaN or infinite, all bit patterns alike: half of them are below 1, some are subnormal.
float any_finite_float(Dice& dice);

/// filter(), and the proof that the backend under test ran it; in the suite's streaming form also that streaming makes
/// the same bits.
Result run(const SampleBuffer& samples, const Settings& settings);
std::vector<float> filtered(const SampleBuffer& samples, const Settings& settings);

/// Nothing where all bits are equal, else the first pixel and channel that differ, with both values.
std::string difference(const std::vector<float>& actual, const std::vector<float>& expected, int width);
/// The same for the pixels that are more than `reach` away from pixel number `pixel`.
std::string difference_beyond_reach(const std::vector<float>& actual, const std::vector<float>& expected, int width,
                                    int pixel);
/// Nothing where all R, G, B are finite and, channel by channel, between the least and the largest of the samples.
std::string outside_hull(const std::vector<float>& pixels, const SampleBuffer& samples);
std::string not_finite(const std::vector<float>& pixels);

/// The frame without one of its samples.
SampleBuffer without(const SampleBuffer& samples, std::uint32_t sample);

/// Makes the world 256 `unit` times as large, and its positions multiples of `unit`.
void snap_positions(SampleBuffer& samples, float unit);
/// Adds to the world positions.
void move_world(SampleBuffer& samples, float x, float y, float z);

}  // namespace rpf::test
