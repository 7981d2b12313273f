// Header attributes: which describe the file and which describe the frame.
#pragma once

#include <string>

namespace rpf::io {

/// The marker of a sample file and its version (docs/file-format.md).
constexpr const char* format_attribute = "rpf:format";
constexpr const char* format_value = "mc-samples";
constexpr const char* version_attribute = "rpf:version";
constexpr int format_version = 1;

/// True for attributes that describe how a file stores its data. They are no metadata: the writer makes its own.
bool is_structural(const std::string& attribute);

/// OpenImageIO renames some of OpenEXR's standard attributes; Metadata has OpenEXR's names.
std::string oiio_name(const std::string& exr_name);
std::string exr_name(const std::string& oiio_name);

}  // namespace rpf::io
