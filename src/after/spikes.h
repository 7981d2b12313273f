// The step between passes that is not in the sources: light of single bright pixels is shared with those around them.
#pragma once

#include <vector>

#include "frame/frame.h"

namespace rpf {

/// A pixel brighter (R + G + B) than each of its 8 neighbors is a spike: its samples are multiplied so that it becomes
/// as bright as the brightest of them, at least 0, and what it loses is added in equal shares to all pixels of the
/// square around it (spike_spread), itself included. All spikes are found before any is spread. Energy, the sum of the
/// pixels, is kept and pixels without samples take no part. Section 7 does the same to the samples inside a pixel.
/// Changes R, G and B of `colors`, [sample][carried].
void spread_spikes(const Frame& frame, std::size_t carried, std::vector<float>& colors);

/// Bytes that spread_spikes takes for so many pixels.
std::uint64_t spikes_bytes(std::uint64_t pixels);

}  // namespace rpf
