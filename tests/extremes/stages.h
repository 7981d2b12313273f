// One pixel of a frame, stage by stage, with the numbers that went in: for comparison with double.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "plan/plan.h"
#include "rpf/samples.h"
#include "rpf/settings.h"
#include "seam/trace.h"

namespace rpf::test {

struct Stages {
  PixelTrace trace;
  Plan plan;
  std::vector<std::vector<double>> values;  ///< [V][N] what entered section 4: scaled radiance, positions, ...
  float radiance_scale = 1;

  std::size_t neighbors() const { return trace.neighbors.size(); }
};

/// The first pass of the backend under test at each of these pixels.
std::vector<Stages> stages_of(const SampleBuffer& samples, const Settings& settings,
                              const std::vector<std::uint32_t>& pixels);

/// Mean and standard deviation of the values that are not NaN, in double, in two passes.
struct Moments {
  double mean = 0, deviation = 0, largest = 0;  ///< largest magnitude
};
Moments moments_of(const std::vector<double>& values);

/// Mutual information in nats of the counts [B][B], by its definition, in double.
double information_of(const std::vector<std::uint32_t>& histogram, std::size_t first, std::size_t bins);

}  // namespace rpf::test
