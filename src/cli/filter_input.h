// What `rpf` filters: a sample file, or an image where the method needs no samples.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/filter_options.h"
#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

struct FilterInput {
  SampleFileInfo info;            ///< of an image: as if it were a sample file
  std::uint64_t image_bytes = 0;  ///< peak bytes of reading an image; 0: samples

  bool is_image() const { return image_bytes > 0; }
};

/// Reads the header of a sample file or an image. Throws Error(input).
FilterInput open_input(const std::string& path, Method method, const SampleReadOptions& options);

/// All files that filtering with these options reads: the input, the network where it is a file, facts of the frame.
std::vector<std::string> files_read(const FilterOptions& options);

/// Reads the rest of it. Throws Error(input), Error(memory).
SampleBuffer read_input(const FilterInput& input, const SampleReadOptions& options);

}  // namespace rpf::cli
