// What the commands that write sample files share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "rpf/io.h"
#include "rpf/rows.h"

namespace rpf::cli {

struct SampleFileOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> map;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
};

/// "INPUT... -o OUTPUT --map --max-memory".
void add_sample_file_options(CLI::App& command, SampleFileOptions& options);

/// --map and the memory limit, the default one where none was given. Throws Error(usage).
SampleReadOptions read_options_of(const SampleFileOptions& options);

/// The slots that are half in every one of these files.
std::vector<std::string> half_slots_of(const std::vector<SampleFileInfo>& files);

/// Writes a file some rows at a time, with progress, and says so. Returns the exit code. Throws as write_sample_rows().
int write_and_tell(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots);

}  // namespace rpf::cli
