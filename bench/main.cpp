// Google Benchmark over roofs, phases and whole frames (docs/bench.md, "Where the time goes").
#include <benchmark/benchmark.h>

#include <cstdio>

#include "bench_frame.h"
#include "rpf/devices.h"

int main(int argc, char** argv) {
  using namespace rpf::measure;
  const bool has_device = !rpf::devices().empty();
  if (!has_device) std::fprintf(stderr, "no OpenCL device: only the reference is measured\n");
  register_host_roofs();
  register_reference_phases();
  if (has_device) {
    register_device_roofs();
    register_device_phases();
    register_frames();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
