#pragma once

#include <chrono>
#include <string>

#include "cli/signals.h"
#include "rpf/filter.h"

namespace rpf::cli {

/// Seconds as people write them, 1:05; unknown where they are negative.
std::string clock_time(double seconds);

/// One line on stderr that says how far the run is and how long it will take; and one, on a terminal or not, where
/// kernels are compiled, for that takes some seconds and happens once.
class ProgressBar {
 public:
  /// `mode`: auto (where stderr is a terminal), never, always.
  explicit ProgressBar(const std::string& mode);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  void say_compiling();

  bool talks_ = false, visible_ = false;
  bool shown_ = false, says_compiling_ = false;
  std::chrono::steady_clock::time_point latest_{};
};

/// Runs work(control), with a control that shows the progress and lets signals stop the work.
template <class Work>
auto with_progress(const std::string& mode, const Work& work) {
  const SignalGuard guard;
  const LastResort last_resort;
  ProgressBar bar(mode);
  Control control;
  control.progress = [&](const Progress& progress) {
    bar.show(progress);
    return received_signal() == 0;
  };
  return work(control);
}

}  // namespace rpf::cli
