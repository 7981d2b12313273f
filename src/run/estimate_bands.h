// How a learned estimate is cut into bands of rows, so that it fits into the memory there is.
#pragma once

#include "rpf/filter.h"
#include "seam/backend.h"

namespace rpf {

struct EstimateBands {
  int rows = 1;             ///< of a band
  std::uint64_t bytes = 0;  ///< peak of the whole run
};

/// The whole crop at once where that fits Settings::max_memory, else the highest bands that do; one row where none
/// does. `room`: columns that the buffer of values can hold.
EstimateBands estimate_bands(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                             const Settings& settings, const Backend& backend);

}  // namespace rpf
