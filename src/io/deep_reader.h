// Deep scan-line OpenEXR in.
#pragma once

#include <memory>
#include <string>

#include "rpf/io.h"
#include "rpf/rows.h"

namespace rpf::io {

/// As inspect_samples() and read_samples() of rpf/io.h and open_sample_rows() of rpf/rows.h, for deep OpenEXR files
/// only.
SampleFileInfo inspect_deep(const std::string& path, const SampleReadOptions& options);
SampleBuffer read_deep(const std::string& path, const SampleReadOptions& options);
std::unique_ptr<SampleRows> open_deep_rows(const std::string& path, const SampleReadOptions& options);

}  // namespace rpf::io
