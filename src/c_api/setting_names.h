// Settings by name and text, as other languages hand them over.
#pragma once

#include <string>

#include "rpf/settings.h"

namespace rpf::c_api {

/// Those of a preset, or of the profile thesis or paper, with the backend that the command takes. Throws Error(usage).
Settings settings_named(const std::string& name);

/// Changes the setting that the option --`name` of the command is. Throws Error(usage) that names it.
void set(Settings& settings, const std::string& name, const std::string& value);

}  // namespace rpf::c_api
