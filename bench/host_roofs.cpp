// What the reference's compiler and flags make of the same kinds of work, on one core.
#include <array>

#include "bench_frame.h"
#include "rpf_math.h"

namespace rpf::measure {
namespace {

/// Sets the roof from what the loop of `state` took; call it behind the loop.
class RoofClock {
 public:
  RoofClock() : start_(cpu_seconds()) {}
  void set(benchmark::State& state, double units, double& roof) const {
    roof = units * static_cast<double>(state.iterations()) / (cpu_seconds() - start_);
    state.counters["1e9/s"] = 1e-9 * roof;
  }

 private:
  double start_;
};

void flops(benchmark::State& state) {
  std::array<float, 32> x{};
  constexpr int rounds = 4096;
  const RoofClock clock;
  for (auto iteration : state) {
    for (int i = 0; i < rounds; ++i)
      for (float& value : x) value = value * 0.5F + 1.0F;
    benchmark::DoNotOptimize(x);
  }
  clock.set(state, 2.0 * rounds * x.size(), host_roofs().flops);
}

void exponentials(benchmark::State& state) {
  std::array<float, 1024> x{}, y{};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = -0.01F * static_cast<float>(i);
  const RoofClock clock;
  for (auto iteration : state) {
    benchmark::DoNotOptimize(x);
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = kernel::rpf_exp(x[i]);
    benchmark::DoNotOptimize(y);
  }
  clock.set(state, x.size(), host_roofs().exponentials);
}

// A row of the neighborhood against one of its variables, as the reference goes through them.
void increments(benchmark::State& state) {
  constexpr std::size_t rows = 128, variables = 32, cells = 49;
  std::array<std::uint8_t, rows * variables> bins{};
  for (std::size_t i = 0; i < bins.size(); ++i)
    bins[i] = static_cast<std::uint8_t>(kernel::rpf_hash(static_cast<kernel::uint>(i), 1, 2).x % 7);
  std::array<std::uint32_t, variables * cells> histograms{};
  const RoofClock clock;
  for (auto iteration : state) {
    for (std::size_t r = 0; r < rows; ++r) {
      const std::uint8_t* row = bins.data() + r * variables;
      std::uint32_t* histogram = histograms.data() + 7 * row[0];
      for (std::size_t v = 0; v < variables; ++v) ++histogram[v * cells + row[v]];
    }
    benchmark::DoNotOptimize(histograms);
  }
  clock.set(state, bins.size(), host_roofs().counts);
}

void read_bytes(benchmark::State& state, std::size_t floats, double& roof) {
  const std::vector<float> values(floats, 1);
  const RoofClock clock;
  for (auto iteration : state) {
    std::array<float, 32> sum{};
    for (std::size_t i = 0; i < values.size(); i += sum.size())
      for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += values[i + l];
    benchmark::DoNotOptimize(sum);
  }
  clock.set(state, static_cast<double>(values.size() * sizeof(float)), roof);
}

void random_records(benchmark::State& state) {
  const std::vector<float> values(frame_records * RPF_LANES, 1);
  std::vector<std::uint32_t> places(1U << 20U);
  for (std::uint32_t i = 0, word = 1; i < places.size(); ++i, word = word * 1664525U + 1013904223U)
    places[i] = static_cast<std::uint32_t>((std::uint64_t{word} * frame_records) >> 32);
  const RoofClock clock;
  for (auto iteration : state) {
    std::array<float, RPF_LANES> sum{};
    for (const std::size_t place : places)
      for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += values[place * RPF_LANES + l];
    benchmark::DoNotOptimize(sum);
  }
  clock.set(state, static_cast<double>(places.size()), host_roofs().random_records);
}

}  // namespace

void register_host_roofs() {
  const std::pair<const char*, void (*)(benchmark::State&)> roofs[] = {
      {"multiply_add", flops},
      {"exp", exponentials},
      {"increments", increments},
      {"read", [](benchmark::State& s) { read_bytes(s, 64U << 20U, host_roofs().read_bytes); }},
      {"read_cached", [](benchmark::State& s) { read_bytes(s, 64U << 10U, host_roofs().cached_bytes); }},
      {"random_records", random_records}};
  for (const auto& [name, work] : roofs)
    benchmark::RegisterBenchmark(("roof.cpu." + std::string(name)).c_str(), work)->Unit(benchmark::kMicrosecond);
}

}  // namespace rpf::measure
