// The files of all frames of a sequence together.
#pragma once

#include <string>
#include <vector>

#include "cli/filter_options.h"

namespace rpf::cli {

/// A frame with its own files.
struct FrameTask {
  std::string name;  ///< the number of the frame; of a file without one its name
  FilterOptions options;
};

/// Throws Error(usage) where a result of a frame is a file that another frame reads or writes, or where `log` is a file
/// of any frame or has the name of an image. `inputs`: of the sequence, those of other frames too. `sequence`: its
/// options, with places for the number of a frame.
void check_sequence_files(const std::vector<FrameTask>& tasks, const std::vector<std::string>& inputs,
                          const FilterOptions& sequence, const std::string& log);

/// Throws Error(input) that names the frames whose input is not there, before others are filtered.
void check_frames_are_there(const std::vector<FrameTask>& tasks);

}  // namespace rpf::cli
