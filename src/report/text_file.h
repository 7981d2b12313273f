#pragma once

#include <string>

namespace rpf::report {

/// Writes a file that is whole or untouched. Throws Error(output).
void write_text(const std::string& path, const std::string& text);

}  // namespace rpf::report
