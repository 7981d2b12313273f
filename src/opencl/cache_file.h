// Files of our caches: whole or not there, and recognized when something happened to them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace rpf {

/// FNV-1a, 64 bits: this is about accidents, not about attacks.
std::uint64_t checksum(const std::string& content);

/// Empty where there is no such file.
std::string content_of(const std::filesystem::path& path);

/// Puts a file in place of what is there, at once; makes its folder. Where that cannot be, all stays as it is: caches
/// are a convenience.
void replace_file(const std::filesystem::path& path, const std::string& content);

}  // namespace rpf
