// Methods that filter pixels on the reference: step after step, each parallel over rows.
#include "cpu/cpu_backend.h"
#include "pixel_steps.h"

namespace rpf {

std::vector<float> CpuBackend::run_steps(const PixelPlan& plan, std::vector<float> planes,
                                         const EstimateProgress& progress) {
  planes.resize(plan.planes * plan.pixels(), 0.0F);
  Workers workers(threads_);
  const double part = 1.0 / static_cast<double>(plan.steps.size());
  for (const kernel::rpf_pixel_step& step : plan.steps) {
    workers.for_all(0, static_cast<std::size_t>(plan.height), [&](std::size_t y, std::size_t /*worker*/) {
      kernel::rpf_run_step(planes.data(), &step, {static_cast<int>(y), 0, plan.width});
    });
    progress(part);
  }
  return planes;
}

std::uint64_t CpuBackend::step_bytes(const PixelPlan& /*plan*/) const { return 0; }

}  // namespace rpf
