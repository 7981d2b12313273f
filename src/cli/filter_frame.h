// One frame from file to file: checked, read, filtered, written. What a single run and a sequence share.
#pragma once

#include <cstdint>
#include <string>

#include "bench/frame_run.h"
#include "cli/facts_file.h"
#include "cli/filter_input.h"
#include "cli/filter_options.h"
#include "cli/origin.h"
#include "rpf/filter.h"

namespace rpf::cli {

/// A frame whose header, outputs and needs were checked.
struct OpenFrame {
  FilterOptions options;  ///< with this frame's files
  Settings settings;
  SampleReadOptions reading;
  FilterInput input;
  std::uint64_t need = 0;  ///< peak bytes of reading and filtering
  bool by_rows = false;    ///< rows are read when they are needed
  FactsFile facts;         ///< of the whole frame, where there are any
};

/// What it is made from, and how; reads the file where there are no facts.
Origin origin_of(const OpenFrame& frame);

/// Whether an image is that part of the frame that is wanted.
bool is_wanted(const OpenFrame& frame, const Image& image);

/// Refuses what cannot be done before anything is read. Throws Error.
OpenFrame open_frame(const FilterOptions& options);

struct ReadFrame {
  SampleBuffer samples;  ///< none where rows are read when they are needed
  Origin origin;
};

/// Bytes that a frame takes once it is read.
std::uint64_t read_bytes(const OpenFrame& frame);

ReadFrame read_frame(const OpenFrame& frame);

/// Filters with these settings and writes, the page about it last; a signal meanwhile throws Error(cancelled) and
/// leaves nothing.
Result filter_and_write(const OpenFrame& frame, const Settings& settings, ReadFrame read);

/// What -v says of a run.
void print_report(const Report& report, Method method);

}  // namespace rpf::cli
