// What the OpenCL device does at most: kernels/roofs.cl on one compute unit.
#include <functional>

#include "bench_frame.h"
#include "opencl/session.h"
#include "pass.h"

namespace rpf::measure {
namespace {

constexpr std::uint32_t plane_words = 256;             // of 64 bits: 16,384 neighbors
constexpr std::uint32_t blocks_in_memory = 4U << 20U;  // vectors of 64 bytes: 256 MiB, far more than caches hold
constexpr std::uint32_t blocks_in_cache = 4U << 10U;   // 256 KiB: the columns of a large neighborhood, in the L2 cache
constexpr std::uint32_t reads = 1U << 22;

Session& session() { return Session::of(find_device("")); }

cl::Kernel kernel(const std::string& name) {
  // frame.cl wants a plan; none of its numbers matters here.
  const char* any_plan =
      "-DRPF_VARIABLES=26 -DRPF_RANDOM=4 -DRPF_FEATURES=17 -DRPF_REJECTING=11 -DRPF_BINS=7 -DRPF_CARRIED=3 "
      "-DRPF_SAMPLES=4 -DRPF_MISSING=0";
  return {session().program("roofs.cl", any_plan), name.c_str()};
}

/// Launches a kernel over and over; `roof` becomes the units a CPU second.
void measure(benchmark::State& state, const cl::Kernel& kernel, double units, double& roof) {
  session().launch(kernel, 1, 1);  // compiles
  double seconds = 0;
  for (auto iteration : state) {
    const double start = cpu_seconds();
    session().launch(kernel, 1, 1);
    const double taken = cpu_seconds() - start;
    state.SetIterationTime(taken);
    seconds += taken;
  }
  roof = units * static_cast<double>(state.iterations()) / seconds;
  state.counters["1e9/s"] = 1e-9 * roof;
}

cl::Buffer result() { return session().buffer(RPF_LANES * sizeof(float)); }

void flops(benchmark::State& state, bool fused) {
  constexpr std::uint32_t rounds = 1U << 20;
  cl::Kernel k = kernel("roof_multiply_add");
  const cl::Buffer out = result();
  k.setArg(0, out);
  k.setArg(1, rounds);
  k.setArg(2, 0.5F);
  k.setArg(3, 1.0F);
  k.setArg(4, fused ? 1 : 0);
  constexpr double chains = 8;
  measure(state, k, 2.0 * rounds * chains * RPF_LANES, fused ? device_roofs().fused_flops : device_roofs().flops);
}

void exponentials(benchmark::State& state) {
  constexpr std::uint32_t rounds = 1U << 18;
  cl::Kernel k = kernel("roof_exp");
  const cl::Buffer out = result();
  k.setArg(0, out);
  k.setArg(1, rounds);
  k.setArg(2, 0.01F);
  constexpr double chains = 8;
  measure(state, k, 1.0 * rounds * chains * RPF_LANES, device_roofs().exponentials);
}

void counts(benchmark::State& state) {
  constexpr std::uint32_t rounds = 1U << 17;
  cl::Kernel k = kernel("roof_popcount");
  const cl::Buffer out = result(),
                   planes = session().copy(std::vector<std::uint64_t>(8 * plane_words, 0x123456789ABCDEFU));
  k.setArg(0, out);
  k.setArg(1, planes);
  k.setArg(2, plane_words);
  k.setArg(3, rounds);
  measure(state, k, 2.0 * rounds * plane_words, device_roofs().counts);
}

void read_bytes(benchmark::State& state, std::uint32_t blocks, double& roof) {
  const std::uint32_t rounds = blocks_in_memory / blocks;
  cl::Kernel k = kernel("roof_read");
  const cl::Buffer out = result(), values = session().copy(std::vector<float>(std::size_t{blocks} * RPF_LANES, 1));
  k.setArg(0, out);
  k.setArg(1, values);
  k.setArg(2, blocks);
  k.setArg(3, rounds);
  measure(state, k, 1.0 * blocks * rounds * RPF_LANES * sizeof(float), roof);
}

void random_records(benchmark::State& state) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0, word = 1; i < reads; ++i, word = word * 1664525U + 1013904223U)
    places.push_back(static_cast<std::uint32_t>((std::uint64_t{word} * frame_records) >> 32));
  cl::Kernel k = kernel("roof_random_read");
  const cl::Buffer out = result(), order = session().copy(places),
                   values = session().copy(std::vector<float>(std::size_t{frame_records} * RPF_LANES, 1));
  k.setArg(0, out);
  k.setArg(1, values);
  k.setArg(2, order);
  k.setArg(3, reads);
  measure(state, k, reads, device_roofs().random_records);
}

}  // namespace

void register_device_roofs() {
  const std::pair<const char*, std::function<void(benchmark::State&)>> roofs[] = {
      {"multiply_add", [](benchmark::State& s) { flops(s, false); }},
      {"fused_multiply_add", [](benchmark::State& s) { flops(s, true); }},
      {"exp", exponentials},
      {"popcount", counts},
      {"read", [](benchmark::State& s) { read_bytes(s, blocks_in_memory, device_roofs().read_bytes); }},
      {"read_cached", [](benchmark::State& s) { read_bytes(s, blocks_in_cache, device_roofs().cached_bytes); }},
      {"random_records", random_records}};
  for (const auto& [name, work] : roofs)
    benchmark::RegisterBenchmark(("roof.opencl." + std::string(name)).c_str(), work)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

}  // namespace rpf::measure
