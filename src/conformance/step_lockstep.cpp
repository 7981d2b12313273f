#include "conformance/step_lockstep.h"

#include "cpu/cpu_backend.h"
#include "opencl/opencl_backend.h"

namespace rpf {
namespace {

/// What the first of the views or points adds up to, and what all of them do.
template <typename Work>
Comparison compare_sums(const char* name_of_first, const Work& first, const Work& all,
                        std::vector<float> (Backend::*run)(const Work&, const EstimateProgress&),
                        const std::string& device_name, int threads) {
  const auto silent = [](double /*part*/) {};
  CpuBackend reference(threads);
  OpenClBackend device({device_name, threads, 0});
  Comparison comparison;
  comparison.at(0, "whole frame");
  comparison.values(name_of_first, (reference.*run)(first, silent), (device.*run)(first, silent));
  comparison.values("sums", (reference.*run)(all, silent), (device.*run)(all, silent));
  return comparison;
}

}  // namespace

Comparison compare_steps(const ConformanceCase& c, SampleBuffer samples, const std::string& device_name, int threads) {
  const PreparedFrame prepared = prepare(std::move(samples), c.settings);
  const PixelPlan plan = make_pixel_plan(prepared.facts, c.settings);
  const std::vector<float> inputs = pixel_planes(prepared, plan.inputs, plan.planes);
  const auto silent = [](double /*part*/) {};
  const std::vector<float> expected = CpuBackend(threads).run_steps(plan, inputs, silent),
                           found = OpenClBackend({device_name, threads, 0}).run_steps(plan, inputs, silent);
  Comparison comparison;
  comparison.at(0, "whole frame");
  comparison.values("planes", expected, found);
  const auto picture = [&](const std::vector<float>& planes) {
    const auto first = planes.begin() + static_cast<std::ptrdiff_t>(plan.result * plan.pixels());
    return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(prepared.facts.carried * plan.pixels()));
  };
  comparison.values("image", picture(expected), picture(found));
  return comparison;
}

Comparison compare_columns(const ConformanceCase& c, SampleBuffer samples, const std::string& device_name,
                           int threads) {
  const PixelColumns columns = make_pixel_columns(prepare(std::move(samples), c.settings), c.settings, threads, [] {});
  PixelColumns first = columns;
  first.points.resize(1);
  return compare_sums("first point", first, columns, &Backend::integrate_columns, device_name, threads);
}

Comparison compare_views(const ConformanceCase& c, SampleBuffer samples, const std::string& device_name, int threads) {
  const LightField light = make_light_field(prepare(std::move(samples), c.settings), c.settings);
  LightField first = light;
  first.views.resize(1);
  return compare_sums("first view", first, light, &Backend::see_views, device_name, threads);
}

}  // namespace rpf
