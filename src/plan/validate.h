// Which settings can be.
#pragma once

#include "rpf/settings.h"

namespace rpf {

/// Throws Error(usage) that names the first setting that cannot be, and what can.
void validate(const Settings& settings);

}  // namespace rpf
