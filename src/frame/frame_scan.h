// What only all samples of a frame together tell: found out rows after rows, for all methods but the learned one.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "frame/clean.h"
#include "frame/clean_frame.h"
#include "frame/facts.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// Enough to prepare any rows of the frame.
struct FrameFindings {
  CleanReport cleaned;
  std::vector<std::string> constant;  ///< selected slots
  float position_diagonal = 0;        ///< FrameFacts
  /// What a scan does not find, because it takes the rows once more, or all at once: FrameFacts, and PreparedFrame,
  /// where the settings ask for them.
  std::vector<FeatureSpread> feature_spread;
  std::vector<std::string> uninformative;
};

/// One value of a prepared record: a column of a sample, or what is computed from it.
struct Source {
  enum Kind { color, plain, fraction } kind = plain;
  std::size_t column = 0;
  float origin = 0;  ///< subtracted from a plain value
};

/// Of a selected slot.
Source source_of(const SampleLayout& layout, const std::string& slot);

/// Of a record whose column has this value.
float value_of(float value, const Source& source, float scale);

class FrameScan {
 public:
  /// `frame`: may be without its samples; outlives this.
  FrameScan(const SampleBuffer& frame, const Settings& settings);

  /// Cleans the next rows and looks at them.
  void add(SampleBuffer& rows);
  /// After all rows.
  FrameFindings findings();

 private:
  struct Channel {
    std::string slot;
    Source source;
    float first = missing;  ///< value that is not missing
    bool varies = false;
  };
  void look_for_variation(const SampleBuffer& rows, Channel& channel) const;
  void include_positions(const SampleBuffer& rows);

  CleanFrame clean_;
  Cleaning cleaning_;
  std::vector<Channel> channels_;
  std::vector<double> low_, high_;  ///< [component] of the box around all first-hit world positions
};

}  // namespace rpf
