// How far a class of devices may be from the reference.
#pragma once

#include <cstdint>

#include "rpf/devices.h"

namespace rpf {

struct ConformanceTolerance {
  std::uint64_t ulp = 0;  ///< units in the last place, at every stage
  const char* reason = "";
};

/// The row of the table that a device falls into.
ConformanceTolerance tolerance_of(const DeviceInfo& device);

}  // namespace rpf
