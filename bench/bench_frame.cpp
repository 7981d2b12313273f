#include "bench_frame.h"

#include <map>

#include "trace_layout.h"

#include "bench/frame_run.h"

namespace rpf::measure {

const SampleBuffer& frame_of(int width, int height) {
  static std::map<std::pair<int, int>, SampleBuffer> frames;
  const auto found = frames.find({width, height});
  if (found != frames.end()) return found->second;
  SceneOptions options;
  options.width = width;
  options.height = height;
  return frames.emplace(std::pair(width, height), render_scene("dof", options)).first->second;
}

Settings settings_for(Profile profile, std::vector<int> box_widths) {
  Settings settings;
  settings.profile = profile;
  settings.box_widths = std::move(box_widths);
  settings.threads = 1;
  return settings;
}

double cpu_seconds() {
  static const bench::CostClock clock;
  return clock.elapsed().cpu;
}

Roofs& device_roofs() {
  static Roofs roofs;
  return roofs;
}

Roofs& host_roofs() {
  static Roofs roofs;
  return roofs;
}

void count(benchmark::State& state, const std::string& unit, double units, double seconds, double roof_seconds) {
  state.counters["ns/" + unit] = 1e9 * seconds / units;
  if (roof_seconds > 0) state.counters["% of roof"] = 100 * roof_seconds / seconds;
}

double weighting_seconds(const Roofs& roofs, const Plan& plan, double weights) {
  if (roofs.flops == 0 || roofs.exponentials == 0) return 0;
  const double coordinates = 3 + static_cast<double>(plan.variables.feature_names.size());
  // A coordinate: difference, square, sum. The weight: its sum, and product and sum for each carried value.
  const double flops = 3 * coordinates + 1 + 2 * static_cast<double>(plan.carried);
  return weights * (flops / roofs.flops + 1 / roofs.exponentials);
}

double pairs_of(const Plan& plan) {
  return kernel::rpf_pairs(static_cast<kernel::uint>(plan.variables.random_names.size()),
                           static_cast<kernel::uint>(plan.variables.feature_names.size()));
}

double column_bytes(const Plan& plan) { return 5 * sizeof(float) * static_cast<double>(plan.variables.count()); }

}  // namespace rpf::measure
