// The library with OpenImageIO in it, loaded when it is first needed.
#pragma once

#include <string>

#include "io/atomic_file.h"
#include "rpf/error.h"
#include "rpf/image.h"

namespace rpf::io {

/// What that library does; images/images.h describes the functions.
struct ImageLibrary {
  Image (*inspect)(const std::string& path);
  Image (*read)(const std::string& path);
  void (*write)(const std::string& path, const AtomicFile& file, const Image& image);
};

/// Loads librpf_images.so from one of its places (parts/parts.h). `kind`: input or output, what it is needed for.
/// Throws Error(kind) that names the file it is needed for where the library is missing.
const ImageLibrary& image_library(ErrorKind kind, const std::string& path);

}  // namespace rpf::io
