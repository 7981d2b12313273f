// Which pixels each pass filters, so that the wanted ones are those of the whole image: what steps and boxes read.
#pragma once

#include "plan/plan.h"

namespace rpf {

/// Pixels to each side that get a share of a spike's excess.
constexpr int spike_spread = 2;
/// Pixels to each side that what this step does to a pixel depends on: the neighbors of a spike that far away.
constexpr int spike_reach = spike_spread + 1;

/// Pixels to each side that a pixel is averaged with, and that patches reach around each of them.
constexpr int polish_radius = 3, polish_patch = 1;
/// Pixels to each side that a polished pixel depends on.
constexpr int polish_reach = polish_radius + polish_patch;

/// The last pass filters the crop and what polishing it reads; each pass before it also what the next one reads around
/// its own region; all of them what the steps after them read.
void plan_regions(Plan& plan, const Window& crop);

}  // namespace rpf
