#include "conformance/lockstep.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "conformance/comparison.h"
#include "conformance/estimator_lockstep.h"
#include "conformance/step_lockstep.h"
#include "cpu/cpu_backend.h"
#include "frame/prepare.h"
#include "frame/resolve.h"
#include "opencl/opencl_backend.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Pixels that are traced beside the corners of the region.
constexpr std::uint32_t traced_inside = 6;

SampleBuffer samples_of(const ConformanceCase& c) {
  SampleBuffer samples = render_scene(c.scene, c.options);
  if (c.change) c.change(samples);
  return samples;
}

Plan plan_of(const PreparedFrame& prepared, const ConformanceCase& c) {
  Plan plan = make_plan(prepared.facts, c.settings);
  plan.explain = c.explain;
  return plan;
}

/// Most bytes of a band that holds `rows` rows, wherever they are; 0: no limit.
std::uint64_t bytes_of_rows(const Frame& frame, const Plan& plan, int rows) {
  std::uint64_t bytes = 0;
  for (int y = 0; rows > 0 && y + rows <= frame.height; ++y)
    bytes = std::max(bytes, band_bytes(frame, SampleFloats(plan), {y, y + rows}));
  return bytes;
}

/// The corners of the region and some pixels inside, others in every pass.
std::vector<std::uint32_t> traced_pixels(const Window& r, int width, int pass) {
  std::vector<std::uint32_t> pixels;
  const auto add = [&](int x, int y) {
    const auto pixel = static_cast<std::uint32_t>((r.y + y) * width + r.x + x);
    if (std::find(pixels.begin(), pixels.end(), pixel) == pixels.end()) pixels.push_back(pixel);
  };
  for (const int y : {0, r.height - 1})
    for (const int x : {0, r.width - 1}) add(x, y);
  for (std::uint32_t i = 0; i < traced_inside; ++i) {
    const kernel::rpf_words words = kernel::rpf_hash(i, static_cast<std::uint32_t>(pass), 1);
    add(static_cast<int>(kernel::rpf_choose(words.x, static_cast<std::uint32_t>(r.width))),
        static_cast<int>(kernel::rpf_choose(words.y, static_cast<std::uint32_t>(r.height))));
  }
  return pixels;
}

class Lockstep {
 public:
  Lockstep(const ConformanceCase& c, const std::string& device, int threads)
      : prepared_(prepare(samples_of(c), c.settings)),
        plan_(plan_of(prepared_, c)),
        reference_(threads),
        device_({device, threads, bytes_of_rows(prepared_.frame, plan_, c.band_rows)}) {
    reference_.load(prepared_.frame, prepared_.colors, plan_);
    device_.load(prepared_.frame, prepared_.colors, plan_);
  }

  Comparison run() {
    for (int pass = 0; pass < static_cast<int>(plan_.passes.size()); ++pass) {
      trace(pass);
      filter(pass);
    }
    comparison_.at(static_cast<int>(plan_.passes.size()) - 1, "image");
    comparison_.values("image", image(reference_), image(device_));
    return std::move(comparison_);
  }

 private:
  void trace(int pass) {
    for (const std::uint32_t pixel :
         traced_pixels(plan_.passes[static_cast<std::size_t>(pass)].region, plan_.width, pass)) {
      comparison_.at(pass, fmt::format("pixel {},{}", pixel % plan_.width, pixel / plan_.width));
      comparison_.traces(reference_.trace(pass, pixel), device_.trace(pass, pixel));
    }
  }

  /// The reference gets the region as one tile, the device as two: tiles must not matter.
  void filter(int pass) {
    const Window& region = plan_.passes[static_cast<std::size_t>(pass)].region;
    const int upper = (region.height + 1) / 3;
    std::vector<float> explained;
    const auto run_device = [&](int top, int height) {
      device_.run(pass, {region.x, top, region.width, height});
      explained.insert(explained.end(), device_.explained().begin(), device_.explained().end());
    };
    reference_.run(pass, region);
    if (upper > 0) run_device(region.y, upper);
    run_device(region.y + upper, region.height - upper);
    reference_.end_pass();
    device_.end_pass();
    comparison_.at(pass, "whole frame");
    if (plan_.explain) comparison_.values("explained", reference_.explained(), explained);
    comparison_.statistics(reference_.statistics(), device_.statistics());
    comparison_.values("frame colors", reference_.colors(), device_.colors());
  }

  std::vector<float> image(const Backend& backend) const {
    return resolve(prepared_.frame, backend.colors(), plan_.carried);
  }

  PreparedFrame prepared_;
  Plan plan_;
  CpuBackend reference_;
  OpenClBackend device_;
  Comparison comparison_;
};

}  // namespace

CaseResult run_in_lockstep(const ConformanceCase& c, const std::string& device, int threads) {
  const auto start = std::chrono::steady_clock::now();
  const auto compare = [&] {
    if (c.network) return compare_estimates(c, samples_of(c), device, threads);
    if (c.settings.method == Method::multidim) return compare_columns(c, samples_of(c), device, threads);
    if (c.settings.method == Method::lightfield) return compare_views(c, samples_of(c), device, threads);
    if (filters_pixels(c.settings.method)) return compare_steps(c, samples_of(c), device, threads);
    return Lockstep(c, device, threads).run();
  };
  const Comparison comparison = compare();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {c.name, comparison.stages(), comparison.first_difference(), seconds.count()};
}

}  // namespace rpf
