#include "run/backends.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cpu/cpu_backend.h"
#include "opencl/opencl_backend.h"
#include "parallel/thread_count.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf {
namespace {

std::unique_ptr<Backend> make_opencl(const Settings& settings) {
  return std::make_unique<OpenClBackend>(OpenClOptions{settings.device, thread_count(settings), 0});
}

/// Whether the reference may stand in for OpenCL: not for a device that somebody named.
bool may_be_replaced(const Settings& settings) { return settings.backend == "auto" && settings.device.empty(); }

/// The reference in place of OpenCL, whose error is `e`; other errors than a device's are passed on.
std::unique_ptr<Backend> make_replacement(const Settings& settings, const Error& e) {
  if (e.kind() != ErrorKind::device) throw;
  return std::make_unique<CpuBackend>(thread_count(settings), fmt::format("no OpenCL: {}", e.what()));
}

std::unique_ptr<Backend> make_best(const Settings& settings) {
  try {
    return make_opencl(settings);
  } catch (const Error& e) {
    if (!may_be_replaced(settings)) throw;
    return make_replacement(settings, e);
  }
}

/// Kernels are what a backend takes time to get ready.
template <class GetReady>
void get_ready_or_replace(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter,
                          const GetReady& get_ready) {
  try {
    get_ready([&] { meter.check_compiling(); });
  } catch (const Error& e) {
    if (!may_be_replaced(settings)) throw;
    backend = make_replacement(settings, e);
  }
}

}  // namespace

std::vector<std::string> backend_names() { return {"cpu", "opencl", "auto"}; }

std::unique_ptr<Backend> make_backend(const Settings& settings) {
  if (settings.backend == "cpu") return std::make_unique<CpuBackend>(thread_count(settings));
  if (settings.backend == "opencl") return make_opencl(settings);
  if (settings.backend == "auto") return make_best(settings);
  throw Error(ErrorKind::usage, fmt::format("backend '{}' is not known; this build has: {}", settings.backend,
                                            fmt::join(backend_names(), ", ")));
}

void get_ready_estimate(std::unique_ptr<Backend>& backend, const Settings& settings, const EstimatePlan& plan,
                        ProgressMeter& meter) {
  get_ready_or_replace(backend, settings, meter,
                       [&](const std::function<void()>& check) { backend->get_ready_estimate(plan, check); });
}

void get_ready_steps(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter) {
  get_ready_or_replace(backend, settings, meter,
                       [&](const std::function<void()>& check) { backend->get_ready_steps(check); });
}

void get_ready_views(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter) {
  get_ready_or_replace(backend, settings, meter,
                       [&](const std::function<void()>& check) { backend->get_ready_views(check); });
}

void get_ready_columns(std::unique_ptr<Backend>& backend, const Settings& settings, ProgressMeter& meter) {
  get_ready_or_replace(backend, settings, meter,
                       [&](const std::function<void()>& check) { backend->get_ready_columns(check); });
}

void load_backend(std::unique_ptr<Backend>& backend, const Settings& settings, const Frame& frame,
                  std::vector<float> colors, const Plan& plan, ProgressMeter& meter) {
  get_ready_or_replace(backend, settings, meter,
                       [&](const std::function<void()>& check) { backend->get_ready(frame, plan, check); });
  backend->watch([&meter] { meter.check(); });
  backend->load(frame, std::move(colors), plan);
}

}  // namespace rpf
