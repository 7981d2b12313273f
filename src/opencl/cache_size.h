// How much compiled programs may take on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace rpf {

/// Removes what was longest not used (by the times of change) of these files and folders, until the rest takes `limit`
/// bytes at most. What was used within the last hour stays: a running program may still load parts of it.
void prune(const std::vector<std::filesystem::path>& entries, std::uintmax_t limit);

/// For prune(): it is used now.
void mark_used(const std::filesystem::path& entry);

}  // namespace rpf
