// What control groups let this process take.
#pragma once

#include <cstdint>
#include <filesystem>

namespace rpf {

/// Bytes, the least that its control group or one above it allows, of version 1 or 2; the largest number where none
/// has a limit. `root`: of the file system, another one for tests.
std::uint64_t control_group_memory(const std::filesystem::path& root);

}  // namespace rpf
