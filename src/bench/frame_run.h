// One measured run: reading a sample file and filtering it, in this process.
#pragma once

#include <optional>
#include <string>

#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/metrics.h"

namespace rpf::bench {

/// Seconds. CPU seconds are those of all threads of the process, PoCL's too.
struct Cost {
  double cpu = 0, wall = 0;
};

/// Measures from its construction on.
class CostClock {
 public:
  CostClock();
  Cost elapsed() const;

 private:
  Cost start_;
};

/// What to run.
struct FrameJob {
  std::string samples;    ///< sample file
  std::string reference;  ///< image; empty: errors are not measured
  Settings settings;
  SampleReadOptions read;
};

struct FrameRun {
  Cost cost;       ///< of reading and filtering; starting the process, writing the image and comparing are left out
  Cost filtering;  ///< of that the filter, from samples in memory to an image in memory
  Report report;
  std::optional<ImageError> error;
};

/// Filters one pixel of the frame, so that kernels are compiled and loaded before anything is measured.
void warm_up(const FrameJob& job, const Control& control);

/// Throws as read_samples(), filter() and compare_images() do.
FrameRun run_frame(const FrameJob& job, const Control& control);

}  // namespace rpf::bench
