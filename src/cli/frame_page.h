// The page of rpf report: a frame before and after, and what is known of how it was made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/frame_run.h"
#include "rpf/filter.h"
#include "rpf/image.h"
#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// What the run that made an image knows of itself, and the image does not.
struct RunFigures {
  Report report;
  Method method = Method::rpf;
  bench::Cost cost;                       ///< of filtering and writing
  std::uint64_t predicted = 0, most = 0;  ///< bytes: of memory predicted, and held by the process at most
};

struct FramePageJob {
  std::string input, output, reference, page;  ///< files; `reference` may be empty
  SampleReadOptions read;                      ///< of the input
  Settings machine;                            ///< threads and memory are taken from it
  std::string progress;                        ///< "auto", "never", "always"
  std::optional<RunFigures> run = {};
};

/// Peak bytes of making the page of a frame beside noise attribution, which is left out where it takes too much.
std::uint64_t page_bytes(const SampleFileInfo& info, bool has_reference);

/// Reads the files and writes the page; tells on standard error how long noise attribution will be at work. Throws
/// Error.
void write_frame_page(const FramePageJob& job);

}  // namespace rpf::cli
