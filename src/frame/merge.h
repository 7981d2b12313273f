// What merging renderings of one frame asks of them, and how their samples are joined.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rpf/samples.h"

namespace rpf {

/// Throws Error(input) where data windows, slots, view or camera of two renderings differ; does not look at their
/// samples.
void check_alike(const SamplePart& first, const SamplePart& other);

/// Throws Error(input) where all parts together, of which one is `first`, hold more than a file can.
void check_total(const std::string& first, std::uint64_t samples);

/// Puts the records of a buffer in the order of another layout that has the same slots.
void reorder(SampleBuffer& samples, const SampleLayout& layout);

/// Whether every pixel of two renderings shares a sample: a file merged with itself, with a merge that holds it, or
/// with more samples of the same seed. Others differ in the first pixel, so this costs nothing.
struct Repetition {
  bool any = false;        ///< a pixel with samples in both has been seen
  bool everywhere = true;  ///< as far as has been looked
  /// Looks at the same pixels of both, with the same order of slots.
  void look(const SampleBuffer& a, const SampleBuffer& b);
  /// Throws Error(input) after all have been looked at.
  void check(const SamplePart& a, const SamplePart& b) const;
};

/// Of the first part, with the seeds of all.
Metadata merged_metadata(const std::vector<SamplePart>& parts);

/// merge_samples() of parts that are known to fit together.
SampleBuffer joined(std::vector<SamplePart> parts);

}  // namespace rpf
