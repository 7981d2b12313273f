#pragma once

#include <string>

namespace rpf::report {

/// The text with &, <, > and quotes as HTML writes them.
std::string escaped(const std::string& text);

/// Base64 of RFC 4648, section 4.
std::string base64(const std::string& bytes);

}  // namespace rpf::report
