// Frames filtered as if they were larger than memory, and what they are compared with: the same frames in core.
#pragma once

#include <string>

#include "rpf/filter.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf::test {

/// filter() of rows that are read when they are needed, in the least memory: one row at a time, none kept.
Result streamed(const SampleBuffer& samples, Settings settings);

/// Why such settings need the frame in memory: a part of what the refusal says. Empty: they stream. Whatever is not
/// listed here has to stream.
std::string refusal_of(const Settings& settings);

/// Nothing where all bits are equal: image, features, attributes, what is reported but for the seconds. Else what
/// differs.
std::string difference(const Result& found, const Result& expected);

/// Nothing where streaming makes `in_core`, what filter() made, bit for bit; or where it is refused as
/// refusal_of() says.
std::string difference_when_streamed(const SampleBuffer& samples, const Settings& settings, const Result& in_core);

}  // namespace rpf::test
