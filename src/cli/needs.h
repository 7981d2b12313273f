// What filtering a file would take, known before it is read.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/rows.h"
#include "rpf/scene.h"
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

/// What rendering may take, and what to say where that is too little.
struct RenderingLimit {
  std::string who;           ///< what is rendered, or the command
  std::uint64_t bytes = 0;   ///< the most
  const char* smaller = "";  ///< what to choose smaller: "--spp or --size"
};

/// Opens a scene to be rendered while it is written. Throws as open_scene_rows() does, and Error(memory) where that
/// would take more than the limit.
std::unique_ptr<SampleRows> open_scene_within(const std::string& scene, const SceneOptions& options,
                                              const RenderingLimit& limit);

/// Refuses a reference in the same way: Error(memory).
void check_reference_need(const SceneOptions& options, const RenderingLimit& limit);

/// "rows are read as they are needed, ..."
std::string text_of(const RowsMemory& need);

/// Bytes that this process has held at most so far.
std::uint64_t peak_memory();

/// Peak bytes of reading and filtering it.
std::uint64_t predicted_memory(const SampleFileInfo& info, const Settings& settings);

}  // namespace rpf::cli
