// Whether a device keeps the numeric contract.
#pragma once

#include <string>

namespace rpf {

class Session;

/// Empty where the device's results are the host's, bit for bit; else the first operation that differs, with both
/// results as hex floats. Takes some milliseconds when the kernel is cached. Throws Error(device) where it cannot run.
std::string self_test(Session& session);

}  // namespace rpf
