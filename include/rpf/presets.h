// Presets: points on the measured curve of time against error (docs/trade.md).
#pragma once

#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// A preset and what it is for.
struct PresetInfo {
  std::string name;
  std::string purpose;  ///< one line: what it is for, and what it gives up
};

/// From the fastest to the most accurate.
std::vector<PresetInfo> presets();

/// The settings of a preset; whatever it does not choose has its default. Throws Error(usage) for an unknown name,
/// naming those there are.
Settings preset_settings(const std::string& name);

/// What a preset is predicted to take on a frame.
struct PresetTime {
  std::string name;
  double seconds = 0;  ///< wall time of filter(), kernels compiled
};

/// Filters a part from the middle of the frame with each preset, on the backend and with the threads of `settings`, and
/// extrapolates to the frame. Takes a few hundredths of the time that it predicts, and compiles the kernels that are
/// missing. In the order of presets(). Throws what filter() throws.
std::vector<PresetTime> predict_presets(const SampleBuffer& samples, const Settings& settings,
                                        const Control& control = {});

/// The most accurate preset that is predicted to take at most `seconds`; the fastest where none does.
PresetTime best_within(const std::vector<PresetTime>& times, double seconds);

}  // namespace rpf
