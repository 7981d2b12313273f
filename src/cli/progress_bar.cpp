#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "cli/print.h"

namespace rpf::cli {
namespace {

constexpr int bar_width = 30;

}  // namespace

std::string clock_time(double seconds) {
  if (seconds < 0) return "--:--";
  const auto s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

ProgressBar::ProgressBar(const std::string& mode)
    : talks_(mode != "never"), visible_(mode == "always" || (mode == "auto" && isatty(STDERR_FILENO) == 1)) {}

ProgressBar::~ProgressBar() {
  if (shown_) remark("\n");
}

void ProgressBar::show(const Progress& progress) {
  if (progress.compiling) return say_compiling();
  const auto now = std::chrono::steady_clock::now();
  const bool is_last = progress.fraction >= 1;
  if (!visible_ || (shown_ && !is_last && now - latest_ < std::chrono::milliseconds(200))) return;
  latest_ = now;
  shown_ = true;
  const int filled = static_cast<int>(progress.fraction * bar_width);
  remark("\rpass {}/{} [{:=<{}}{:<{}}] {:3.0f} %  {} left ", progress.pass + 1, progress.passes, "", filled, "",
         bar_width - filled, 100 * progress.fraction, clock_time(is_last ? 0 : progress.seconds_left));
}

void ProgressBar::say_compiling() {
  if (!talks_ || says_compiling_) return;
  says_compiling_ = true;
  remark("{}compiling kernels for the OpenCL device, once\n", shown_ ? "\n" : "");
  shown_ = false;
}

}  // namespace rpf::cli
