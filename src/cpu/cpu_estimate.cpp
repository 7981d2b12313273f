// The learned estimator on the reference (docs/network.md): stage after stage, each parallel over rows.
#include <algorithm>

#include "cpu/cpu_backend.h"
#include "cpu/estimate.h"

namespace rpf {
namespace {

/// Multiply-adds between two looks at progress: a fraction of a second for a core without vectors.
constexpr double work_at_once = 3e8;

}  // namespace

void CpuBackend::load_estimate(const Frame& frame, const EstimatePlan& plan) {
  frame_ = &frame;
  estimate_plan_ = &plan;
}

std::vector<float> CpuBackend::estimate_window(const Window& window, const EstimateProgress& progress,
                                               std::vector<EstimateStage>* stages) {
  double samples = 0;
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x)
      samples += frame_->samples(static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_->width) +
                                 static_cast<std::size_t>(x));
  const double all = Estimate::work(*estimate_plan_, window, samples);
  Workers workers(threads_);
  const auto for_rows = [&](int rows, double row_work, const std::function<void(int)>& row) {
    const double at_once = work_at_once * threads_ / std::max(row_work, 1.0);
    const int step = static_cast<int>(std::clamp(at_once, 1.0, static_cast<double>(rows)));
    for (int first = 0; first < rows; first += step) {
      const int end = std::min(first + step, rows);
      workers.for_all(static_cast<std::size_t>(first), static_cast<std::size_t>(end),
                      [&](std::size_t i, std::size_t /*worker*/) { row(static_cast<int>(i)); });
      progress(row_work * (end - first) / all);
    }
  };
  return Estimate(*frame_, *estimate_plan_, window, for_rows, stages).run();
}

std::vector<float> CpuBackend::estimate(const Window& region, const EstimateProgress& progress) {
  const Window window = window_around(*estimate_plan_, region);
  const std::vector<float> all = estimate_window(window, progress, nullptr);
  std::vector<float> part;
  const std::size_t carried = estimate_plan_->carried;
  part.reserve(region.pixel_count() * carried);
  for (int y = 0; y < region.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(region.y - window.y + y) * static_cast<std::size_t>(window.width);
    const float* first = all.data() + (row + static_cast<std::size_t>(region.x - window.x)) * carried;
    part.insert(part.end(), first, first + static_cast<std::size_t>(region.width) * carried);
  }
  return part;
}

std::vector<EstimateStage> CpuBackend::trace_estimate(const Window& region) {
  std::vector<EstimateStage> stages;
  estimate_window(
      window_around(*estimate_plan_, region), [](double /*part*/) {}, &stages);
  return stages;
}

std::uint64_t CpuBackend::estimate_bytes(const EstimatePlan& plan, const Window& window,
                                         std::uint64_t /*samples*/) const {
  return Estimate::bytes(plan, window);
}

}  // namespace rpf
