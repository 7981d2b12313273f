// What `rpf` filters: a sample file, or an image where the method needs no samples.
#pragma once

#include <optional>
#include <string>

#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

struct FilterInput {
  SampleFileInfo info;                ///< of an image: as if it were a sample file
  std::optional<SampleBuffer> image;  ///< its pixels as samples; nothing: samples are still to be read
};

/// Reads the header of a sample file, or a whole image. Throws Error(input).
FilterInput open_input(const std::string& path, Method method, const SampleReadOptions& options);

}  // namespace rpf::cli
