// A first run of a program's kernels with nothing to do: PoCL compiles a kernel when it is launched.
#pragma once

#include <string>

#include "opencl/session.h"

namespace rpf {

/// Compiles a program as Session::program() does, and launches each of its kernels with zeros for all arguments and
/// buffers of zeros. Every kernel, of kernels/ or generated (`more`), must take that for nothing to do. Throws
/// Error(device).
void rehearse(Session& session, const std::string& file, const std::string& definitions, const std::string& more);

}  // namespace rpf
