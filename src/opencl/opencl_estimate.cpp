// The learned estimator on a device.
#include "opencl/estimate_run.h"
#include "opencl/opencl_backend.h"

namespace rpf {

void OpenClBackend::get_ready_estimate(const EstimatePlan& plan, const std::function<void()>& check) {
  network_ = on_device("preparing the network", [&] {
    return std::make_unique<NetworkProgram>(session_, plan, blocking_.value_or(blocking_of(session_.device())), check);
  });
  ready_for_ = &plan;
}

void OpenClBackend::load_estimate(const Frame& frame, const EstimatePlan& plan) {
  if (ready_for_ != &plan) get_ready_estimate(plan, {});
  ready_for_ = nullptr;
  frame_ = &frame;
  estimate_plan_ = &plan;
}

std::vector<float> OpenClBackend::estimate(const Window& region, const EstimateProgress& progress) {
  const Window window = window_around(*estimate_plan_, region);
  return on_device("estimating", [&] {
    const int first = region.y - window.y;
    EstimateRun run(session_, *network_, {*frame_, *estimate_plan_, window}, first, first + region.height, items_,
                    false);
    return run.run(region.x - window.x, region.width, progress);
  });
}

std::vector<EstimateStage> OpenClBackend::trace_estimate(const Window& region) {
  const Window window = window_around(*estimate_plan_, region);
  return on_device("tracing the estimator", [&] {
    return EstimateRun(session_, *network_, {*frame_, *estimate_plan_, window}, 0, window.height, items_, true).trace();
  });
}

std::uint64_t OpenClBackend::estimate_bytes(const EstimatePlan& plan, const Window& window,
                                            std::uint64_t samples) const {
  const auto count = static_cast<double>(samples);
  return EstimateSteps(plan, window, count, 0, window.height, false).bytes() +
         static_cast<std::uint64_t>(EstimateSteps::most_kept(plan, count));
}

}  // namespace rpf
