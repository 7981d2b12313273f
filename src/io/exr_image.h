// Flat OpenEXR images out: the format that the filter's results have, without OpenImageIO.
#pragma once

#include <string>

#include "io/atomic_file.h"
#include "rpf/image.h"

namespace rpf::io {

/// Fills the temporary file of `path` with 32-bit float channels, zip compressed, and reads it back. Throws
/// Error(output).
void write_exr_image(const std::string& path, const AtomicFile& file, const Image& image);

}  // namespace rpf::io
