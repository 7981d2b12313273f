// A frame before its records are made: what preparing begins with, whatever the method.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frame/clean.h"
#include "frame/prepare.h"
#include "frame/selection.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

struct CleanFrame {
  SampleBuffer samples;  ///< those that can be used; what is missing is NaN
  Columns columns;
  Selection selection;
  std::vector<std::size_t> carried;  ///< columns of what is averaged beside the color
  PreparedFrame prepared;            ///< without records, colors, first_sample and what says how these came to be
};

/// Leaves out unusable samples, marks missing values, finds the scale of the radiance.
CleanFrame clean_frame(SampleBuffer samples, const Settings& settings);

/// "lens.U" of the slot "random.lens.U".
std::string short_name(const std::string& slot);

/// What is averaged, sample by sample: the scaled color where it is wanted, then CleanFrame::carried; 0 for a value
/// that is missing, which has nothing to average.
std::vector<float> carried_values(const CleanFrame& clean, bool with_color);

/// The largest number of samples in one pixel.
std::uint32_t most_samples(const std::vector<std::uint32_t>& first_sample);

}  // namespace rpf
