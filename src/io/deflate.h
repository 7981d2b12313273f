#pragma once

#include <string>

namespace rpf::io {

/// The bytes as a zlib stream (RFC 1950).
std::string deflated(const std::string& bytes);

}  // namespace rpf::io
