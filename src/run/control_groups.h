// What control groups let this process take.
#pragma once

#include <cstdint>
#include <filesystem>

namespace rpf {

/// Bytes, the least that its control group or one above it allows, of version 1 or 2; the largest number where none
/// has a limit. `root`: of the file system, another one for tests.
std::uint64_t control_group_memory(const std::filesystem::path& root);

/// Threads that the processors keep busy which its control group and those above it allow (cpu.max, of version 1
/// cpu.cfs_quota_us), rounded up; the largest number where none has a limit.
int control_group_threads(const std::filesystem::path& root);

}  // namespace rpf
