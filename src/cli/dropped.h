// What a file holds that no result of it will: said, and never lost in place.
#pragma once

#include <string>

#include "rpf/io.h"

namespace rpf::cli {

/// The file as what is written into an image of that name: an alpha that its format has no room for has no slot.
SampleFileInfo as_image(SampleFileInfo info, const std::string& output);

/// One remark that lists channels without a slot and attributes of unknown types; nothing where there are none.
void tell_dropped(const SampleFileInfo& info);

/// One remark that counts samples whose color is not finite, of which densities make nothing.
void tell_not_finite(const SampleBuffer& samples);

/// Throws Error(usage) where `output` would replace the file and something of it would be dropped, or would be stored
/// in fewer bits than it has.
void check_in_place(const SampleFileInfo& info, const std::string& output);

}  // namespace rpf::cli
