// How wrong each pixel of a filtered frame is, from two halves of its samples.
#pragma once

#include "rpf/filter.h"

namespace rpf {

/// filter() with Settings::estimate_error: Result::features has the channel "error" behind the others (10.3).
Result filter_with_error(SampleBuffer samples, const Settings& settings, const Control& control);

}  // namespace rpf
