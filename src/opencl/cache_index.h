// Which programs of PoCL's kernel cache belong to a source: so that a run looks only at what it is going to load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rpf {

/// The programs that a source led to so far, or nothing where that is not known for sure. `source` is all that decides
/// what is compiled: text, options, device.
std::vector<std::filesystem::path> indexed_programs(const std::filesystem::path& folder, const std::string& source);

/// Adds programs to those that a source led to. PoCL's naming may change under us; a source may have several.
void index_programs(const std::filesystem::path& folder, const std::string& source,
                    const std::vector<std::filesystem::path>& programs);

/// The programs in a cache folder of which this process has loaded a kernel.
std::vector<std::filesystem::path> loaded_programs(const std::filesystem::path& folder);

}  // namespace rpf
