#pragma once

#include <chrono>

#include "rpf/filter.h"

namespace rpf::cli {

/// One line on stderr that says how far the run is and how long it will take.
class ProgressBar {
 public:
  /// `mode`: auto (where stderr is a terminal), never, always.
  explicit ProgressBar(const std::string& mode);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  bool visible_ = false, shown_ = false;
  std::chrono::steady_clock::time_point latest_{};
};

}  // namespace rpf::cli
