// What the commands of `rpf bench` share.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/frame_run.h"
#include "bench/run_json.h"
#include "bench/statistics.h"
#include "bench/sweep_plan.h"

namespace rpf::cli {

/// Which frames to measure, as `rpf bench frames` and `rpf bench ab` take them.
struct BenchFrames {
  std::vector<std::string> files, references;
  std::string scene = "dof", size = "240x135";  ///< where no file is named
};

struct FramesOptions {
  BenchFrames frames;
  std::vector<std::string> sets;  ///< NAME=OPTIONS
  int rounds = 5;
  bool json = false;
};

struct AbOptions {
  BenchFrames frames;
  std::string a, b;                ///< options of the filter
  std::string binary_a, binary_b;  ///< empty: this one
  int rounds = 9;
  bool json = false;
};

struct SweepOptions {
  std::string plan, output;
  int rounds = 0;  ///< 0: as the plan says
};

/// Each returns the exit code.
int run_frames(const FramesOptions& options);
int run_ab(const AbOptions& options);
int run_sweep(const SweepOptions& options);

/// A folder that is removed with what is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The frames that were named, or the scene, to be rendered into `folder`. Throws Error(usage).
std::vector<bench::SweepFrame> frames_of(const BenchFrames& options, const std::string& folder);

/// "NAME=OPTIONS", or only options, which are their own name then.
bench::SweepSetting setting_of(const std::string& text);

/// Reads `options` with the parser of the filter command. Throws Error(usage) that names the setting.
bench::FrameJob job_of(const bench::SweepFrame& frame, const bench::SweepSetting& setting);

/// Finds before anything is rendered or measured what the job would end with. Throws Error(input) where a file is
/// missing or the reference shows something else, Error(usage) for a scene or a number of samples that cannot be,
/// Error(memory) where rendering or filtering a scene takes more than the job may; `smaller`: what helps then.
void check_frame(const bench::SweepFrame& frame, const bench::FrameJob& job, const char* smaller);

/// Lets signals stop the work; shows nothing.
Control stoppable();

/// One line on a terminal's stderr that is overwritten by the next; an empty text clears it.
void show_status(const std::string& text);

nlohmann::ordered_json json_of(const bench::Summary& summary, const std::vector<double>& rounds);

}  // namespace rpf::cli
