// Where the scalar reference spends its time: each phase of a pixel. Names: dof.4spp.240x135.cpu.<profile>.<box
// width>.<phase>
#include "bench_frame.h"
#include "cpu/neighborhood.h"
#include "cpu/statistics.h"
#include "cpu/weighting.h"

namespace rpf::measure {
namespace {

/// A pixel's state up to the phase that is measured.
struct Pixel {
  Neighborhood neighborhood;
  Normalization normalization;
  Dependencies dependencies;
  FilterWeights weights;
  FilterScratch scratch;
  std::vector<float> out;
};

enum class Phase { gather, prepare, information, weights };
constexpr const char* phase_names[] = {"gather", "prepare", "information", "weights"};

void run_phase(Phase phase, const PlannedFrame& f, std::uint32_t number, Pixel& pixel) {
  const std::uint32_t own = f.prepared.frame.samples(number);
  switch (phase) {
    case Phase::gather:
      return gather(f.prepared.frame, f.plan, 0, number, pixel.neighborhood);
    case Phase::prepare:
      return normalize(pixel.neighborhood, pixel.normalization);
    case Phase::information:
      measure_dependencies(f.plan, 0, pixel.neighborhood, pixel.dependencies);
      return compute_weights(f.plan, 0, pixel.dependencies, pixel.weights);
    case Phase::weights:
      pixel.out.resize(own * f.plan.carried);
      return filter_samples(f.plan, pixel.neighborhood, own, pixel.weights, f.prepared.colors, pixel.scratch,
                            pixel.out.data(), nullptr);
  }
}

/// What the pixels visited were worth.
struct Work {
  double pixels = 0, draws = 0, neighbors = 0, weights = 0;
};

void count_phase(benchmark::State& state, const PlannedFrame& f, Phase phase, const Work& work, double seconds) {
  const Roofs& roofs = host_roofs();
  const auto at_roof = [](double units, double rate) { return rate > 0 ? units / rate : 0; };
  const double lines = static_cast<double>(f.plan.variables.count()) / RPF_LANES;
  const double pairs = work.neighbors * pairs_of(f.plan);
  switch (phase) {
    case Phase::gather:
      return count(state, "draw", work.draws, seconds, at_roof(work.draws * lines, roofs.random_records));
    case Phase::prepare:
      return count(state, "neighbor", work.neighbors, seconds,
                   at_roof(work.neighbors * column_bytes(f.plan), roofs.cached_bytes));
    case Phase::information:
      return count(state, "pair_and_neighbor", pairs, seconds, at_roof(pairs, roofs.counts));
    case Phase::weights:
      return count(state, "weight", work.weights, seconds, weighting_seconds(roofs, f.plan, work.weights));
  }
}

/// Measures one phase; the phases before it run with the clock stopped.
void measure(benchmark::State& state, const Settings& settings, Phase phase) {
  const PlannedFrame f(frame_of(phases_width, phases_height), settings);
  Pixel pixel;
  std::uint32_t number = 0;
  Work work;
  double seconds = 0;
  for (auto iteration : state) {
    number = (number + 977) % (phases_width * phases_height);  // a prime step: pixels of all kinds
    for (int before = 0; before < static_cast<int>(phase); ++before)
      run_phase(static_cast<Phase>(before), f, number, pixel);
    const double start = cpu_seconds();
    run_phase(phase, f, number, pixel);
    const double taken = cpu_seconds() - start;
    state.SetIterationTime(taken);
    seconds += taken;
    ++work.pixels;
    work.draws += f.plan.passes[0].neighborhood.draws(f.prepared.frame.samples(number));
    work.neighbors += pixel.neighborhood.size();
    work.weights += static_cast<double>(pixel.neighborhood.size()) * f.prepared.frame.samples(number);
  }
  count_phase(state, f, phase, work, seconds);
  state.counters["N"] = work.neighbors / work.pixels;
}

}  // namespace

void register_reference_phases() {
  for (const auto& [profile, name] : {std::pair(Profile::thesis, "thesis"), std::pair(Profile::paper, "paper")})
    for (const int box : {55, 17, 7})
      for (const Phase phase : {Phase::gather, Phase::prepare, Phase::information, Phase::weights}) {
        const std::string label = "dof.4spp.240x135.cpu." + std::string(name) + "." + std::to_string(box) + "." +
                                  phase_names[static_cast<int>(phase)];
        benchmark::RegisterBenchmark(label.c_str(), measure, settings_for(profile, {box}), phase)
            ->UseManualTime()
            ->MinTime(0.1)
            ->Unit(benchmark::kMicrosecond);
      }
}

}  // namespace rpf::measure
