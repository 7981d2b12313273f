#include "conformance/estimator_lockstep.h"

#include <fmt/format.h>

#include <algorithm>

#include "cpu/cpu_backend.h"
#include "learned/observe.h"
#include "opencl/opencl_backend.h"

namespace rpf {
namespace {

/// The crop's pixels as the device estimates them, in two bands: bands must not matter.
std::vector<float> in_bands(Backend& device, const Window& crop) {
  const auto silent = [](double /*part*/) {};
  const int upper = (crop.height + 1) / 3;
  std::vector<float> pixels;
  if (upper > 0) pixels = device.estimate({crop.x, crop.y, crop.width, upper}, silent);
  const std::vector<float> lower = device.estimate({crop.x, crop.y + upper, crop.width, crop.height - upper}, silent);
  pixels.insert(pixels.end(), lower.begin(), lower.end());
  return pixels;
}

}  // namespace

Comparison compare_estimates(const ConformanceCase& c, SampleBuffer samples, const std::string& device_name,
                             int threads) {
  const Observed observed = observe(std::move(samples), c.settings, c.network);
  const PreparedFrame& prepared = observed.prepared;
  const EstimatePlan& plan = observed.plan;
  CpuBackend reference(threads);
  OpenClBackend device({device_name, threads, 0});
  reference.load_estimate(prepared.frame, plan);
  device.load_estimate(prepared.frame, plan);

  Comparison comparison;
  const Window& crop = prepared.facts.crop;
  const std::vector<EstimateStage> expected = reference.trace_estimate(crop), found = device.trace_estimate(crop);
  comparison.at(0, "all stages");
  for (std::size_t i = 0; i < std::max(expected.size(), found.size()); ++i) {
    const EstimateStage none;
    const EstimateStage &e = i < expected.size() ? expected[i] : none, &f = i < found.size() ? found[i] : none;
    comparison.values(e.name == f.name ? e.name : fmt::format("{} or {}", e.name, f.name), e.values, f.values);
  }
  comparison.at(0, "in bands");
  comparison.values("image", reference.estimate(crop, [](double /*part*/) {}), in_bands(device, crop));
  return comparison;
}

}  // namespace rpf
