#include "conformance/step_lockstep.h"

#include "cpu/cpu_backend.h"
#include "opencl/opencl_backend.h"

namespace rpf {

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
  const auto silent = [](double /*part*/) {};
  CpuBackend reference(threads);
  OpenClBackend device({device_name, threads, 0});
  Comparison comparison;
  PixelColumns first = columns;
  first.points.resize(1);
  comparison.at(0, "whole frame");
  comparison.values("first point", reference.integrate_columns(first, silent), device.integrate_columns(first, silent));
  comparison.values("sums", reference.integrate_columns(columns, silent), device.integrate_columns(columns, silent));
  return comparison;
}

Comparison compare_views(const ConformanceCase& c, SampleBuffer samples, const std::string& device_name, int threads) {
  const LightField light = make_light_field(prepare(std::move(samples), c.settings), c.settings);
  const auto silent = [](double /*part*/) {};
  CpuBackend reference(threads);
  OpenClBackend device({device_name, threads, 0});
  Comparison comparison;
  LightField first = light;
  first.views.resize(1);
  comparison.at(0, "whole frame");
  comparison.values("first view", reference.see_views(first, silent), device.see_views(first, silent));
  comparison.values("sums", reference.see_views(light, silent), device.see_views(light, silent));
  return comparison;
}

}  // namespace rpf
