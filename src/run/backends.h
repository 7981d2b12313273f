// The only place that knows all backends.
#pragma once

#include <memory>

#include "rpf/settings.h"
#include "seam/backend.h"

namespace rpf {

/// Creates the backend that Settings::backend and Settings::device ask for; "auto" is OpenCL where a device passes the
/// self-test, else the reference, whose description then says why. Throws Error(usage) for an unknown name,
/// Error(device) where it cannot work.
std::unique_ptr<Backend> make_backend(const Settings& settings);

}  // namespace rpf
