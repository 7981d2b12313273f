// Damaged files in PoCL's kernel cache: found and removed, for PoCL loads them without a look and aborts the process.
#pragma once

#include <filesystem>

namespace rpf {

/// Records size and checksum of the compiled programs in a cache folder that have no such record yet. Call it after a
/// program ran: what ran is whole.
void seal_cache(const std::filesystem::path& folder);

/// Removes the programs that differ from their record, or have none and are visibly damaged, and temporary files that
/// PoCL forgot more than a day ago. Programs that another process is just compiling stay.
void clean_cache(const std::filesystem::path& folder);

}  // namespace rpf
