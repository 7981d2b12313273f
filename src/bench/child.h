// Runs another program and takes what it prints: how rpf bench ab measures two binaries.
#pragma once

#include <string>
#include <vector>

namespace rpf::bench {

/// Runs a program (a path, or a name on PATH) with its arguments and returns its standard output; its standard error
/// goes where ours goes. A signal that arrives meanwhile ends it too. Throws Error: of the kind that its exit code
/// stands for, Error(cancelled) where it ended by that signal, Error(usage) where it cannot be started.
std::string output_of(const std::vector<std::string>& command);

}  // namespace rpf::bench
