// Points that fill five dimensions evenly.
#pragma once

#include <array>

namespace rpf {

/// Where the additive recurrence of five dimensions is after n steps, 0 .. 1 (Roberts 2018): evenly spread for any
/// number. For the film's x and y, time, and two of the lens.
std::array<double, 5> place_in_sequence(int n);

}  // namespace rpf
