// Where the OpenCL backend spends its time. Its filter is one kernel; a phase is what the kernel with it takes more
// than the kernel without it (RPF_PHASES of kernels/filter.cl), both run one after the other in every iteration.
#include <array>
#include <map>
#include <memory>

#include "bench_frame.h"
#include "opencl/opencl_backend.h"

namespace rpf::measure {
namespace {

constexpr Window tile{72, 40, 96, 54};  // its middle: most boxes are inside the frame

constexpr double line_bytes = 64;

enum Phase { draw, gather, prepare, information, weights, phases };
constexpr const char* phase_names[phases] = {"draw", "gather", "prepare", "information", "weights"};

/// One pass, and how much work its tile is.
struct Pass {
  PlannedFrame frame;
  std::array<std::unique_ptr<OpenClBackend>, phases> backends;  ///< with the phases up to this one
  double pixels = 0, draws = 0, neighbors = 0, weights = 0;

  explicit Pass(const Settings& settings) : frame(frame_of(phases_width, phases_height), settings) {
    for (int phase = 0; phase < phases; ++phase) {
      OpenClOptions options;
      options.phases = phase + 1;
      backends[phase] = std::make_unique<OpenClBackend>(options);
      backends[phase]->load(frame.prepared.frame, frame.prepared.colors, frame.plan);
      backends[phase]->run(0, {tile.x, tile.y, 1, 1});  // compiles
    }
    count_work();
  }

  double seconds(int phase) {
    const double start = cpu_seconds();
    backends[phase]->run(0, tile);
    return cpu_seconds() - start;
  }

 private:
  void count_work() {
    backends[information]->run(0, tile);
    for (int y = tile.y; y < tile.y + tile.height; ++y)
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * phases_width + x;
        const PixelStatistics& s = backends[information]->statistics()[pixel];
        ++pixels;
        draws += s.drawn;
        neighbors += s.neighbors;
        weights += static_cast<double>(s.neighbors) * frame.prepared.frame.samples(pixel);
      }
  }
};

Pass& pass_of(const Settings& settings) {
  static std::map<std::pair<int, int>, std::unique_ptr<Pass>> passes;
  auto& pass = passes[{static_cast<int>(settings.profile), settings.box_widths.front()}];
  if (!pass) pass = std::make_unique<Pass>(settings);
  return *pass;
}

/// Cells of a joint histogram that are counted, a vector at a time; the last row follows from the margin.
double counted_cells(const Plan& plan) {
  const auto bins = 2 * static_cast<kernel::uint>(plan.half_bins) + 1;
  return 2.0 * plan.half_bins * kernel::rpf_bin_vectors(bins) * RPF_BINS_AT_ONCE;
}

/// Counts each phase in its own unit. Roofs are upper limits: bins that nobody is in and colors that do not matter cost
/// nothing.
void count_phase(benchmark::State& state, const Pass& pass, int phase, double seconds) {
  const Plan& plan = pass.frame.plan;
  const Roofs& roofs = device_roofs();
  const double lines = static_cast<double>(SampleFloats(plan).chunks) / RPF_LANES;
  const double pairs = pairs_of(plan) * pass.neighbors;
  const auto at_roof = [](double units, double rate) { return rate > 0 ? units / rate : 0; };
  switch (phase) {
    case draw:
      return count(state, "draw", pass.draws, seconds, 0);
    case gather:
      return count(state, "draw", pass.draws, seconds,
                   at_roof(pass.draws + (lines - 1) * pass.neighbors, roofs.random_records));
    case prepare:
      return count(state, "neighbor", pass.neighbors, seconds,
                   at_roof(2 * lines * line_bytes * pass.neighbors, roofs.cached_bytes));  // for means, then deviations
    case information:
      return count(state, "pair_and_neighbor", pairs, seconds, at_roof(pairs * counted_cells(plan) / 64, roofs.counts));
    default:
      return count(state, "weight", pass.weights, seconds, weighting_seconds(roofs, plan, pass.weights));
  }
}

void measure(benchmark::State& state, const Settings& settings, int phase) {
  Pass& pass = pass_of(settings);
  double seconds = 0;
  for (auto iteration : state) {
    const double before = phase > 0 ? pass.seconds(phase - 1) : 0;
    const double taken = std::max(0.0, pass.seconds(phase) - before);
    state.SetIterationTime(taken);
    seconds += taken;
  }
  seconds /= static_cast<double>(state.iterations());
  count_phase(state, pass, phase, seconds);
  state.counters["us/pixel"] = 1e6 * seconds / pass.pixels;
  state.counters["N"] = pass.neighbors / pass.pixels;
}

}  // namespace

void register_device_phases() {
  for (const auto& [profile, name] : {std::pair(Profile::thesis, "thesis"), std::pair(Profile::paper, "paper")})
    for (const int box : {55, 35, 17, 7})
      for (int phase = 0; phase < phases; ++phase) {
        const std::string label =
            "dof.4spp.240x135.opencl." + std::string(name) + "." + std::to_string(box) + "." + phase_names[phase];
        benchmark::RegisterBenchmark(label.c_str(), measure, settings_for(profile, {box}), phase)
            ->UseManualTime()
            ->MinTime(0.1)  // of the difference; what is run for it takes many times as long
            ->Unit(benchmark::kMillisecond);
      }
}

}  // namespace rpf::measure
