// A pixel's trace from the device: what the kernel wrote for it, and what is left in the scratch of the work-item.
#pragma once

#include <vector>

#include "opencl/scratch.h"
#include "seam/trace.h"
#include "trace_layout.h"

namespace rpf {

/// The trace of a pixel without samples.
PixelTrace empty_trace(int pass, std::uint32_t pixel);

class TraceReader {
 public:
  TraceReader(Session& session, const Plan& plan, int pass, std::uint32_t pixel, std::uint32_t own);

  const cl::Buffer& values() const { return values_; }
  const cl::Buffer& histograms() const { return histograms_; }
  /// Number of filtered values of the pixel.
  std::size_t colors() const { return own_ * plan_.carried; }
  /// After the launch. `colors`: what the pass ends with.
  PixelTrace read(const Scratch& scratch, std::uint32_t neighbors, std::vector<float> colors);

 private:
  /// Sections 3 to 5 but the neighbors, which are known.
  void read_statistics(const Scratch& scratch, const std::vector<float>& values, PixelTrace& t);
  std::vector<float> part(const std::vector<float>& values, std::uint32_t at, std::size_t count) const;
  std::vector<std::uint8_t> bins(const Scratch& scratch, std::uint32_t neighbors);

  Session& session_;
  const Plan& plan_;
  int pass_;
  std::uint32_t pixel_, own_;
  kernel::rpf_trace_layout at_;
  cl::Buffer values_, histograms_;
};

}  // namespace rpf
