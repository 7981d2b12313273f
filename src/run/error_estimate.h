// How wrong each pixel of a filtered frame is, from two halves of its samples.
#pragma once

#include "rpf/filter.h"

namespace rpf {

/// Throws Error(input) where no pixel has what the method needs in each half of its samples.
void check_halves(const FrameSize& size, Method method);

/// filter() with Settings::estimate_error: Result::features has the channel "error" behind the others (10.3).
Result filter_with_error(SampleBuffer samples, const Settings& settings, const Control& control);

}  // namespace rpf
