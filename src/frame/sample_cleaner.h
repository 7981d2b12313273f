// Single samples that need to be cleaned.
#pragma once

#include <cstddef>
#include <cstdint>

#include "frame/clean.h"
#include "rpf/samples.h"

namespace rpf {

/// Moves samples forward to `kept`, or leaves them there.
void move_samples(SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::uint32_t kept);

/// Cleans samples, and counts what it finds.
class SampleCleaner {
 public:
  /// As for Cleaning. What it is given outlives this.
  SampleCleaner(const Columns& columns, bool clamp_negative, CleanFindings& findings)
      : columns_(columns), clamp_negative_(clamp_negative), findings_(findings) {}

  /// Moves the samples of a pixel that can be used to `kept`, all of them where none can. Returns how many. `marks`: of
  /// the samples of the buffer; those that are not `unclean` are not looked at.
  std::uint32_t keep_samples(SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::uint32_t kept,
                             const Marks& marks, std::size_t pixel);

  /// Counts a pixel without samples, or whose samples, before they are cleaned, all weigh nothing.
  void count_pixel(const SampleBuffer& samples, std::uint32_t begin, std::uint32_t end, std::size_t pixel);

 private:
  bool clean_usable(float* record, std::size_t pixel);  ///< false: it is to be left out
  void clean_lost(float* record, std::size_t pixel);
  void take_infinite(float* record, std::size_t pixel);
  bool is_usable(const float* record, std::size_t pixel);
  void clean(float* record, std::size_t pixel);
  void mark_missing(float* record, std::size_t pixel);

  const Columns& columns_;
  bool clamp_negative_;
  CleanFindings& findings_;
};

}  // namespace rpf
