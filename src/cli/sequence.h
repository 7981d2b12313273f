// Frames of a sequence in one process: kernels are compiled once, and the next frame is read while one is filtered.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/filter_options.h"

namespace rpf::cli {

struct SequenceOptions {
  std::string frames, chunk, log;
  bool skip_existing = false, skip_bad_frames = false;
};

void add_sequence_options(CLI::App& app, SequenceOptions& options);

/// Where an option of sequences is given, or the input's name has a place for the number of a frame.
bool is_sequence(const FilterOptions& filter, const SequenceOptions& options);

/// One status line a frame on standard output; the last one lists the frames that failed. Returns the largest exit code
/// of all frames.
int run_sequence(const FilterOptions& filter, const SequenceOptions& options);

}  // namespace rpf::cli
