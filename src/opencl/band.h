// The part of a frame that is on the device: whole rows, as many as fit.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "opencl/session.h"
#include "pass.h"
#include "plan/plan.h"

namespace rpf {

/// Rows of a frame: begin .. end - 1.
struct Rows {
  int begin = 0, end = 0;
  bool contains(const Rows& o) const { return begin <= o.begin && o.end <= end; }
};

/// What a pass reads and writes, for some rows. On a device that shares the host's memory only `chunks` is a copy; it
/// is made from `records` and `colors`, which nothing else reads.
struct Band {
  int pass = 0;
  Rows rows;
  std::uint32_t first_pixel = 0, first_sample = 0;
  std::uint32_t samples = 0;
  cl::Buffer first_samples;  ///< [pixel + 1]
  cl::Buffer records;        ///< [sample][variables]
  cl::Buffer chunks;       ///< records and c' as the kernels read them: laid out on the device, by filter.cl or box.cl
  cl::Buffer colors;       ///< [sample][carried] c'
  cl::Buffer next_colors;  ///< [sample][carried] c''
  cl::Buffer statistics;   ///< [pixel]
};

/// Floats a sample.
struct SampleFloats {
  std::size_t chunks = 0;  ///< of Band::chunks; for filter.cl whole vectors
  std::size_t carried = 0;

  explicit SampleFloats(const Plan& plan);
};

/// The frame-wide arrays that bands are parts of.
struct BandSource {
  const Frame& frame;
  const std::vector<float>& colors;
  std::vector<float>& next_colors;
  std::vector<kernel::rpf_pixel_statistics>& statistics;
  SampleFloats floats;
};

/// Most bytes on the device: of all buffers of a band together, and of one of them.
struct BandLimit {
  std::uint64_t total = 0, buffer = 0;
};

/// Bytes of the buffers of these rows.
std::uint64_t band_bytes(const Frame& frame, const SampleFloats& floats, const Rows& rows);

/// Whether these rows can be on the device at once.
bool fits(const Frame& frame, const SampleFloats& floats, const Rows& rows, const BandLimit& limit);

/// The whole frame where it fits, else as many rows as fit from needed.begin on. `needed` itself fits.
Rows rows_that_fit(const Frame& frame, const SampleFloats& floats, const Rows& needed, const BandLimit& limit);

Band make_band(Session& session, const BandSource& source, int pass, const Rows& rows);

}  // namespace rpf
