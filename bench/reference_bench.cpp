// Where the scalar reference spends its time: each phase of a pixel, and whole frames, on the example file.
// Names: example.4spp.<box width>.cpu.<profile>.<phase>. Counter: time over all neighbors of the pixels visited.
#include <benchmark/benchmark.h>

#include <functional>

#include "cpu/neighborhood.h"
#include "cpu/statistics.h"
#include "cpu/weighting.h"
#include "rpf/rpf.h"

namespace rpf {
namespace {

Settings settings_for(Profile profile, std::vector<int> box_widths) {
  Settings settings;
  settings.profile = profile;
  settings.box_widths = std::move(box_widths);
  settings.threads = 1;
  return settings;
}

const SampleBuffer& example() {
  static const SampleBuffer samples = read_samples(RPF_EXAMPLE);
  return samples;
}

/// A pixel's state up to the phase that is measured.
struct Pixel {
  Neighborhood neighborhood;
  Normalization normalization;
  Dependencies dependencies;
  FilterWeights weights;
  FilterScratch scratch;
  std::vector<float> out;
};

enum class Phase { gather, normalize, dependencies, weights, filter };
constexpr const char* phase_names[] = {"gather", "normalize", "dependencies", "weights", "filter"};

void run_phase(Phase phase, const PreparedFrame& p, const Plan& plan, std::uint32_t number, Pixel& pixel) {
  const std::uint32_t own = p.frame.samples(number);
  switch (phase) {
    case Phase::gather:
      return gather(p.frame, plan, 0, number, pixel.neighborhood);
    case Phase::normalize:
      return normalize(pixel.neighborhood, pixel.normalization);
    case Phase::dependencies:
      return measure_dependencies(plan, 0, pixel.neighborhood, pixel.dependencies);
    case Phase::weights:
      return compute_weights(plan, 0, pixel.dependencies, pixel.weights);
    case Phase::filter:
      pixel.out.resize(own * plan.carried);
      return filter_samples(plan, pixel.neighborhood, own, pixel.weights, p.colors, pixel.scratch, pixel.out.data(),
                            nullptr);
  }
}

/// Measures one phase; the phases before it run with the clock stopped.
void measure_phase(benchmark::State& state, const Settings& settings, Phase phase) {
  const PreparedFrame prepared = prepare(example(), settings);
  const Plan plan = make_plan(prepared.facts, settings);
  const auto pixels = static_cast<std::uint32_t>(prepared.frame.first_sample.size() - 1);
  Pixel pixel;
  std::uint32_t number = 0;
  double neighbors = 0;
  for (auto iteration : state) {
    state.PauseTiming();
    number = (number + 977) % pixels;  // a prime step: pixels of all kinds
    for (int before = 0; before < static_cast<int>(phase); ++before)
      run_phase(static_cast<Phase>(before), prepared, plan, number, pixel);
    state.ResumeTiming();
    run_phase(phase, prepared, plan, number, pixel);
    neighbors += pixel.neighborhood.size();
  }
  state.counters["per neighbor"] =
      benchmark::Counter(neighbors, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void measure_frame(benchmark::State& state, const Settings& settings) {
  for (auto iteration : state) benchmark::DoNotOptimize(filter(example(), settings));
}

void register_profile(Profile profile, const std::string& name) {
  for (const int box : {55, 17, 7})
    for (const Phase phase : {Phase::gather, Phase::normalize, Phase::dependencies, Phase::weights, Phase::filter}) {
      const std::string label =
          "example.4spp." + std::to_string(box) + ".cpu." + name + "." + phase_names[static_cast<int>(phase)];
      benchmark::RegisterBenchmark(label.c_str(), measure_phase, settings_for(profile, {box}), phase);
    }
  benchmark::RegisterBenchmark(("example.4spp.all.cpu." + name).c_str(), measure_frame,
                               settings_for(profile, {55, 35, 17, 7}))
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace rpf

int main(int argc, char** argv) {
  rpf::register_profile(rpf::Profile::thesis, "thesis");
  rpf::register_profile(rpf::Profile::paper, "paper");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
