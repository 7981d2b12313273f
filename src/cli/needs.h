// What filtering a file would take, known before it is read.
#pragma once

#include <cstdint>

#include "rpf/io.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// The slots of a file that filtering with these settings reads. Throws Error(usage) for a group that is not there.
SampleLayout needed_layout(const SampleFileInfo& info, const Settings& settings);

/// Peak bytes of reading and filtering it.
std::uint64_t predicted_memory(const SampleFileInfo& info, const Settings& settings);

}  // namespace rpf::cli
