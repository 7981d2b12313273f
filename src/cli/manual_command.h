// rpf manual man|bash|zsh|fish: for packages.
#pragma once

#include "cli/commands.h"

namespace rpf::cli {

/// Keeps a reference to the parser, whose texts it prints.
Command add_manual_command(CLI::App& app);

}  // namespace rpf::cli
