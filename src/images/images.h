// Images of every format but EXR's writing, through OpenImageIO. Compiled into a library of its own that is loaded when
// the first such image comes along: OpenImageIO brings 250 more libraries, and loading them takes 0.2 CPU seconds and
// 110 MB, more than everything else around the filter.
#pragma once

#include <string>

#include "io/atomic_file.h"
#include "rpf/image.h"

namespace rpf::images {

/// As inspect_image() and read_image() of rpf/io.h.
Image inspect(const std::string& path);
Image read(const std::string& path);

/// Fills the temporary file of `path` and reads it back; the format follows from the extension. Throws Error(output).
void write(const std::string& path, const io::AtomicFile& file, const Image& image);

}  // namespace rpf::images
