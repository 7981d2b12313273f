// Which kind of sample file is written, by the extension of its name.
#pragma once

#include <string>

namespace rpf::io {

enum class SampleFormat { deep_exr, raw };

/// In any case of letters. Throws Error(output) that names both extensions.
SampleFormat sample_format_of(const std::string& path);

/// The extension of a path in small letters, with its dot.
std::string extension_of(const std::string& path);

}  // namespace rpf::io
