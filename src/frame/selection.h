// Which channels of the samples are modeled.
#pragma once

#include <string>
#include <vector>

#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// Which columns of a sample buffer the settings ask for.
struct Selection {
  std::vector<std::string> random;    ///< slots; pixel.X and pixel.Y stand for the position inside the pixel
  std::vector<std::string> features;  ///< slots
};

/// Resolves groups to slots. Throws Error(usage) for a group that the layout does not have, naming those it has.
Selection select_channels(const SampleLayout& layout, const Settings& settings);

/// What the selection is made of, and what every method takes: needed_slots() of rpf/filter.h, but for what a network
/// does not look at.
std::vector<std::string> selected_slots(const SampleLayout& layout, const Settings& settings);

}  // namespace rpf
