// Header attributes: which describe the file and which describe the frame.
#pragma once

#include <string>

#include "rpf/samples.h"

namespace rpf::io {

/// What format_attribute and version_attribute say of a sample file (docs/file-format.md).
constexpr const char* format_value = "mc-samples";
constexpr int format_version = 1;

/// True for attributes that describe how a file stores its data. They are no metadata: the writer makes its own.
bool is_structural(const std::string& attribute);

/// OpenImageIO renames some of OpenEXR's standard attributes; Metadata has OpenEXR's names.
std::string oiio_name(const std::string& exr_name);
std::string exr_name(const std::string& oiio_name);

}  // namespace rpf::io
