#include "cli/needs.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include "cli/print.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

void check_rendering_need(std::uint64_t need, const RenderingLimit& limit) {
  if (need > limit.bytes)
    throw Error(
        ErrorKind::memory,
        fmt::format("{}: rendering takes {:.0f} MB of memory, the limit is {:.0f} MB; choose a smaller {}", limit.who,
                    static_cast<double>(need) / megabyte, static_cast<double>(limit.bytes) / megabyte, limit.smaller));
}

std::uint64_t pixels_of(const SceneOptions& scene) {
  return static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
}

}  // namespace

SampleLayout needed_layout(const SampleFileInfo& info, const Settings& settings) {
  SampleLayout all;
  for (const SampleFileChannel& channel : info.channels)
    if (!channel.slot.empty()) all.slots.push_back(channel.slot);
  return {needed_slots(all, settings)};
}

std::string name_in_group(const std::string& slot) { return slot.substr(slot.find('.') + 1); }

FrameSize frame_size(const SampleFileInfo& info) {
  return {info.data_window.pixel_count(), info.sample_count, info.max_samples, info.data_window.width};
}

void check_need(const SampleFileInfo& info, const char* doing, std::uint64_t need, std::uint64_t limit,
                const char* help) {
  if (need > limit)
    throw Error(ErrorKind::memory,
                fmt::format("{}: {} needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory{}", info.path, doing,
                            static_cast<double>(need) / megabyte, static_cast<double>(limit) / megabyte, help));
}

void check_images_need(const char* command, std::size_t images, std::uint64_t need, std::uint64_t limit) {
  if (need > limit)
    throw Error(ErrorKind::memory,
                fmt::format("{}: {} images need {:.0f} MB of memory, the limit is {:.0f} MB; raise --max-memory, or {} "
                            "fewer or smaller ones",
                            command, images, static_cast<double>(need) / megabyte,
                            static_cast<double>(limit) / megabyte, command));
}

std::unique_ptr<SampleRows> open_scene_within(const std::string& scene, const SceneOptions& options,
                                              const RenderingLimit& limit) {
  const std::uint64_t counts = pixels_of(options) * sizeof(std::uint32_t);
  check_rendering_need(counts, limit);
  auto rows = open_scene_rows(scene, options);
  check_rendering_need(counts + write_rows_memory(*rows), limit);
  return rows;
}

void check_reference_need(const SceneOptions& options, const RenderingLimit& limit) {
  check_rendering_need(pixels_of(options) * (2 * 3 * sizeof(float) + sizeof(double)), limit);  // again when written
}

std::string text_of(const RowsMemory& need) {
  const double need_mb = static_cast<double>(need.bytes) / megabyte;
  if (need.rows_held == 0)
    return fmt::format("rows are read as they are needed, about {} at once: {:.0f} MB at least", need.rows_read,
                       need_mb);
  return fmt::format("rows are read as they are needed, {} at once, {} in memory: {:.0f} MB", need.rows_read,
                     need.rows_held, need_mb);
}

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

std::uint64_t predicted_memory(const SampleFileInfo& info, const Settings& settings) {
  return predict_memory(frame_size(info), needed_layout(info, settings), settings);
}

}  // namespace rpf::cli
