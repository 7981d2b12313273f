// From a sample buffer to a frame.
#pragma once

#include <string>
#include <vector>

#include "frame/facts.h"
#include "frame/frame.h"
#include "rpf/filter.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

struct FrameFindings;

/// A frame with what preparing it found out.
struct PreparedFrame {
  Frame frame;
  FrameFacts facts;
  /// [sample][carried]: c' before the first pass. Not of the learned estimator: Frame::others.
  std::vector<float> colors;
  std::vector<std::string> carried_names;  ///< R, G, B, [A], [features as in the file]
  std::vector<std::string> dropped;        ///< selected channels that are constant over the frame
  std::vector<std::string> uninformative;  ///< those left out by drop_uninformative()
  std::vector<InputNote> notes;
};

/// Leaves out unusable samples, marks missing values, drops constant channels, scales the radiance and repacks the
/// records in place (algorithm.md, section 1; docs/architecture.md, "One run"). For all methods but the learned one,
/// which observe() prepares.
PreparedFrame prepare(SampleBuffer samples, const Settings& settings);

/// The same of some rows of a frame that were cleaned, with what FrameScan found in the whole: the others are left
/// without samples. `frame`: without samples.
PreparedFrame prepare_rows(SampleBuffer rows, const SampleBuffer& frame, const FrameFindings& found,
                           const Settings& settings);

}  // namespace rpf
