// The only place that knows all backends.
#pragma once

#include <memory>
#include <vector>

#include "rpf/settings.h"
#include "run/progress_meter.h"
#include "seam/backend.h"

namespace rpf {

/// Creates the backend that Settings::backend and Settings::device ask for; "auto" is OpenCL where a device passes the
/// self-test, else the reference, whose description then says why. Throws Error(usage) for an unknown name,
/// Error(device) where it cannot work.
std::unique_ptr<Backend> make_backend(const Settings& settings);

/// Has a backend of make_backend() get ready for an estimate, and tells `meter` where kernels are compiled. Where
/// "auto" chose one that does not get ready it becomes the reference, whose description then says why.
void get_ready_estimate(std::unique_ptr<Backend>& backend, const Settings& settings, const EstimatePlan& plan,
                        ProgressMeter& meter);

/// The same for the steps of a method that filters pixels.
void get_ready_steps(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter);
/// The same for the views of a light field.
void get_ready_views(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter);
/// The same for columns of pixels.
void get_ready_columns(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter);

/// The same for the passes of a plan, and load(). `meter` also watches the backend.
void load_backend(std::unique_ptr<Backend>& backend, const Settings& settings, const Frame& frame,
                  std::vector<float> colors, const Plan& plan, ProgressMeter& meter);

}  // namespace rpf
