// What rpf facts writes: the facts of a frame, and of which file and with which settings they were found.
#pragma once

#include <string>
#include <vector>

#include "cli/filter_options.h"
#include "cli/origin.h"

namespace rpf::cli {

struct FactsFile {
  std::string facts;  ///< as of find_facts()
  Origin origin;      ///< of the whole frame: no crop is in it
  std::string ends;   ///< of the input
};

/// Hashes of a file and of settings without their crop.
Origin frame_origin(const std::string& input_hash, Settings settings, const std::vector<std::string>& map);

/// Throws Error(output).
void write_facts(const std::string& path, const FactsFile& file);

/// Throws Error(input) where it cannot be read, or is of another input or other settings than these.
FactsFile read_facts(const std::string& path, const std::string& input, const Settings& settings,
                     const std::vector<std::string>& map);

}  // namespace rpf::cli
