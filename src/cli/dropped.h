// What a file holds that no result of it will: said, and never lost in place.
#pragma once

#include <string>

#include "rpf/io.h"

namespace rpf::cli {

/// One remark that lists channels without a slot and attributes of unknown types; nothing where there are none.
void tell_dropped(const SampleFileInfo& info);

/// Throws Error(usage) where `output` would replace the file and something of it would be dropped, or would be stored
/// in fewer bits than it has.
void check_in_place(const SampleFileInfo& info, const std::string& output);

}  // namespace rpf::cli
