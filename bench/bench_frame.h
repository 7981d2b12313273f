// What the benchmarks share: the frame they filter, settings, clocks, counters.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "frame/prepare.h"
#include "plan/plan.h"
#include "rpf/rpf.h"

namespace rpf::measure {

/// Of the frame whose phases are measured.
constexpr int phases_width = 240, phases_height = 135, phases_samples = 4;
constexpr std::uint32_t frame_records = phases_width * phases_height * phases_samples;

/// The scene dof at 4 samples a pixel, rendered once a size.
const SampleBuffer& frame_of(int width, int height);

/// One thread.
Settings settings_for(Profile profile, std::vector<int> box_widths);

/// A prepared frame with its plan of one pass.
struct PlannedFrame {
  PreparedFrame prepared;
  Plan plan;

  PlannedFrame(const SampleBuffer& samples, const Settings& settings)
      : prepared(prepare(samples, settings)), plan(make_plan(prepared.facts, settings)) {}
};

/// Seconds of all threads of this process since the start of the program.
double cpu_seconds();

/// What kinds of work a machine does at most, a second. 0: not measured in this run.
struct Roofs {
  double flops = 0;         ///< multiplications and additions, each rounded
  double fused_flops = 0;   ///< the same in fused operations; nothing of the filter may use them
  double exponentials = 0;  ///< rpf_exp
  double counts = 0;  ///< histogram work: device: 64-bit words AND and popcount; host: increments of a joint histogram
  double read_bytes = 0;      ///< from memory, in order
  double cached_bytes = 0;    ///< from the L2 cache, in order
  double random_records = 0;  ///< of 64 bytes, over as much memory as the frame takes
};

Roofs& device_roofs();
Roofs& host_roofs();

/// Counters "ns/<unit>" and, where the roof is known, "% of roof": `roof_seconds` is what the roofs allow for all
/// units.
void count(benchmark::State& state, const std::string& unit, double units, double seconds, double roof_seconds);

/// Seconds that the last phase of filtering `weights` pairs of own sample and neighbor takes at the roof.
double weighting_seconds(const Roofs& roofs, const Plan& plan, double weights);

/// Pairs of variables whose mutual information is measured.
double pairs_of(const Plan& plan);

/// Bytes of the records of a neighbor, as columns that are written, read three times and written again.
double column_bytes(const Plan& plan);

// Each registers its benchmarks. Roofs come first: what follows says how near it comes to them.
void register_device_roofs();
void register_host_roofs();
void register_device_phases();
void register_reference_phases();
void register_frames();

}  // namespace rpf::measure
