// Refusals by header: what a sample file must be before any sample is read.
#pragma once

#include <string>
#include <vector>

#include "io/exr_header.h"
#include "rpf/io.h"

namespace rpf::io {

/// The largest width and height of a data window, in pixels.
constexpr std::int64_t max_side = std::int64_t{1} << 20;

/// The pixels between two corners. Throws Error(input) for windows that are empty or larger than `limit` on a side.
Window window_of(const std::string& path, const char* attribute, const Corners& corners, std::int64_t limit);

/// Sampling of all channels, compression, number of chunks: what OpenEXR itself cannot read or we do not trust.
void check_storage(const std::string& path, const DeepHeader& header);

/// The marker, or film. or random. slots in its place: all else is depth-composited data.
void check_marker(const std::string& path, const DeepHeader& header, const std::vector<SampleFileChannel>& channels);

/// R, G, B, film.X and film.Y are filled, and no used channel holds integers.
void check_slots(const std::string& path, const std::vector<SampleFileChannel>& channels);

}  // namespace rpf::io
