// Deep scan-line OpenEXR in.
#pragma once

#include <string>

#include "rpf/io.h"

namespace rpf::io {

/// As inspect_samples() and read_samples() of rpf/io.h, for deep OpenEXR files only.
SampleFileInfo inspect_deep(const std::string& path, const SampleReadOptions& options);
SampleBuffer read_deep(const std::string& path, const SampleReadOptions& options);

}  // namespace rpf::io
