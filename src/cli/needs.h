// What filtering a file would take, known before it is read.
#pragma once

#include <cstdint>
#include <string>

#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/rows.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// The slots of a file that filtering with these settings reads. Throws Error(usage) for a group that is not there.
SampleLayout needed_layout(const SampleFileInfo& info, const Settings& settings);

/// "N.X" of the slot "feature.N.X".
std::string name_in_group(const std::string& slot);

FrameSize frame_size(const SampleFileInfo& info);

constexpr const char* fewer_channels = ", lower --threads or leave channels out with --features and --random";

/// Refuses what needs more than the limit, before anything is read: Error(memory) that says what helps beside a higher
/// limit. `doing`: "filtering".
void check_need(const SampleFileInfo& info, const char* doing, std::uint64_t need, std::uint64_t limit,
                const char* help = fewer_channels);

/// The same of images that a command reads, "compare" say.
void check_images_need(const char* command, std::size_t images, std::uint64_t need, std::uint64_t limit);

/// "rows are read as they are needed, ..."
std::string text_of(const RowsMemory& need);

/// Bytes that this process has held at most so far.
std::uint64_t peak_memory();

/// Peak bytes of reading and filtering it.
std::uint64_t predicted_memory(const SampleFileInfo& info, const Settings& settings);

}  // namespace rpf::cli
