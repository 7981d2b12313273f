#pragma once

namespace rpf {

/// "major.minor.patch" of the library, as `rpf --version` prints it.
const char* version();

}  // namespace rpf
