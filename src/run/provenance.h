// How an image was made, as attributes of its file.
#pragma once

#include "rpf/filter.h"

namespace rpf {

/// The input's metadata, less what marks a sample file, with rpf:* attributes for the software, the settings that
/// change the picture, and what was left out of the input.
Metadata provenance(Metadata input, const Settings& settings, const Report& report);

}  // namespace rpf
