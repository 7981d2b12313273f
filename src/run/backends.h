// The only place that knows all backends.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "rpf/settings.h"
#include "seam/backend.h"

namespace rpf {

/// Creates the backend that Settings::backend and Settings::device ask for; "auto" is OpenCL where a device passes the
/// self-test, else the reference, whose description then says why. Throws Error(usage) for an unknown name,
/// Error(device) where it cannot work.
std::unique_ptr<Backend> make_backend(const Settings& settings);

/// load() of a backend of make_backend(), after get_ready() and watch(). Where "auto" chose one that does not get ready
/// it becomes the reference, whose description then says why.
void load_backend(std::unique_ptr<Backend>& backend, const Settings& settings, const Frame& frame,
                  std::vector<float> colors, const Plan& plan, const std::function<void()>& check);

}  // namespace rpf
