// What became of the frames of a sequence: told line by line, and kept as JSON lines for pipelines.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "rpf/filter.h"

namespace rpf::cli {

enum class FrameStatus { done, skipped, checked, failed };

struct FrameOutcome {
  std::string name;  ///< the number of the frame; of a file without one its name
  std::string input, output;
  FrameStatus status = FrameStatus::done;
  int exit_code = 0;
  std::string error;               ///< of a failed frame
  double seconds = 0;              ///< wall time since the frame before it
  const Report* report = nullptr;  ///< of a frame that is done
};

class FrameLog {
 public:
  /// Appends to the file at `path`; empty: none. Throws Error(output) where it cannot be opened.
  FrameLog(const std::string& path, bool quiet);

  /// At once, so that nothing is lost with the process. Throws Error(output) where the file is full.
  void add(const FrameOutcome& outcome);

  /// The line at the end: how many frames were done, and which failed; `left`: were not begun.
  void finish(std::size_t left);

  int exit_code() const { return exit_code_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  bool quiet_;
  int exit_code_ = 0;
  std::size_t counts_[4] = {};
  std::vector<std::string> failed_;
};

}  // namespace rpf::cli
