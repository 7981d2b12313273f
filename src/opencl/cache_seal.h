// Damaged files in PoCL's kernel cache: found and removed, for PoCL loads them without a look and aborts the process.
#pragma once

#include <filesystem>
#include <vector>

namespace rpf {

/// The folders of all programs in a cache folder.
std::vector<std::filesystem::path> all_programs(const std::filesystem::path& folder);

/// Records the checksums of the programs' compiled files where they have no such record yet. Call it after a program
/// ran: what ran is whole.
void seal(const std::vector<std::filesystem::path>& programs);

/// Removes those of the programs that differ from their record, or have none and are visibly damaged. Programs that
/// another process is just compiling stay.
void remove_damaged(const std::vector<std::filesystem::path>& programs);

/// Removes temporary files that PoCL left in a cache folder more than a day ago.
void remove_forgotten_files(const std::filesystem::path& folder);

}  // namespace rpf
