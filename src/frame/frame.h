// The prepared frame: what a backend loads. Only what is modeled is in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "rpf/filter.h"
#include "rpf/samples.h"

namespace rpf {

struct Frame {
  int width = 0, height = 0;
  std::size_t variables = 0;                ///< floats a record: color 3, position 2, random parameters, features
  std::vector<std::uint32_t> first_sample;  ///< [width * height + 1]
  std::vector<float> records;               ///< [sample][variables]; the color scaled; a missing value is NaN
  bool has_missing = false;                 ///< whether any value of the records is NaN
  std::vector<float> weights;               ///< [sample]: share in the pixel's mean; empty: all equal

  const float* record(std::size_t sample) const { return records.data() + sample * variables; }
  std::uint32_t samples(std::size_t pixel) const { return first_sample[pixel + 1] - first_sample[pixel]; }
  std::size_t sample_count() const { return first_sample.back(); }
};

/// A frame with what preparing it found out.
struct PreparedFrame {
  Frame frame;
  FrameFacts facts;
  std::vector<float> colors;               ///< [sample][carried]: c' before the first pass
  float radiance_scale = 1;                ///< the power of two that the color was multiplied with
  std::vector<std::string> carried_names;  ///< R, G, B, [A], [features as in the file]
  std::vector<std::string> dropped;        ///< selected channels that are constant over the frame
  std::vector<std::string> uninformative;  ///< those left out by drop_uninformative()
  std::vector<InputNote> notes;
};

/// Which columns of a sample buffer the settings ask for.
struct Selection {
  std::vector<std::string> random;    ///< slots; pixel.X and pixel.Y stand for the position inside the pixel
  std::vector<std::string> features;  ///< slots
};

/// Resolves groups to slots. Throws Error(usage) for a group that the layout does not have, naming those it has.
Selection select_channels(const SampleLayout& layout, const Settings& settings);

/// The largest number of samples in one pixel.
std::uint32_t most_samples(const std::vector<std::uint32_t>& first_sample);

/// Leaves out unusable samples, marks missing values, drops constant channels, scales the radiance and repacks the
/// records in place (algorithm.md, section 1; docs/architecture.md, "Preparing a frame").
PreparedFrame prepare(SampleBuffer samples, const Settings& settings);

}  // namespace rpf
