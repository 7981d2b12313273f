// Methods that filter pixels on a device: a launch for every step.
#include "opencl/opencl_backend.h"

namespace rpf {
namespace {

constexpr const char* file = "pixel_steps.cl";

/// Pixels times steps that the device is asked for before it is waited for: some tenths of a second.
constexpr double work_at_once = 3e7;

}  // namespace

void OpenClBackend::get_ready_steps(const std::function<void()>& check) {
  on_device("compiling", [&] { session_.rehearse(file, "", "", check); });
}

std::vector<float> OpenClBackend::run_steps(const PixelPlan& plan, std::vector<float> planes,
                                            const EstimateProgress& progress) {
  planes.resize(plan.planes * plan.pixels(), 0.0F);
  on_device("filtering", [&] {
    cl::Kernel kernel(session_.program(file, ""), "pixel_step");
    const std::size_t bytes = planes.size() * sizeof(float);
    const cl::Buffer buffer = session_.host_buffer(planes.data(), bytes, CL_MEM_READ_WRITE);
    kernel.setArg(0, buffer);
    const double part = 1.0 / static_cast<double>(plan.steps.size());
    double asked_for = 0, work = 0;
    const auto wait = [&] {
      session_.finish();
      progress(asked_for);
      asked_for = work = 0;
    };
    for (const kernel::rpf_pixel_step& step : plan.steps) {
      kernel.setArg(1, step);
      session_.enqueue(kernel, items_, 1);
      asked_for += part;
      work += static_cast<double>(plan.pixels());
      if (work > work_at_once * static_cast<double>(items_)) wait();
    }
    wait();
    session_.read_back(buffer, 0, bytes, planes.data());
  });
  return planes;
}

std::uint64_t OpenClBackend::step_bytes(const PixelPlan& plan) const {
  const bool is_cpu = (session_.device().getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  return is_cpu ? 0 : plan.planes * plan.pixels() * sizeof(float);
}

}  // namespace rpf
