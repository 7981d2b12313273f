// What this process was started with.
#pragma once

#include <string>

namespace rpf {

/// The value of an environment variable; empty where it is not set.
std::string environment(const char* variable);

}  // namespace rpf
