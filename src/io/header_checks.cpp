#include "io/header_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/attributes.h"
#include "io/guard.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

constexpr std::size_t listed_channels = 12;  // in an error text

[[noreturn]] void reject(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("\"{}\" {}", path, what));
}

std::string channel_names(const std::vector<SampleFileChannel>& channels) {
  std::string text;
  for (std::size_t i = 0; i < std::min(channels.size(), listed_channels); ++i)
    text += (i == 0 ? "" : ", ") + channels[i].name;
  if (channels.size() > listed_channels) text += fmt::format(" and {} more", channels.size() - listed_channels);
  return text;
}

// No program writes these into depth-composited data.
bool marks_samples(const std::string& slot) {
  return slot.compare(0, 5, "film.") == 0 || slot.compare(0, 7, "random.") == 0;
}

const char* meaning(const std::string& slot) {
  if (slot == "film.X" || slot == "film.Y") return "the sample's position on the film, in pixels";
  return "the sample's radiance";
}

/// Says where the channel of a slot's name went, where it has gone to another slot.
void check_not_taken(const std::string& path, const std::vector<SampleFileChannel>& channels, const std::string& slot) {
  for (const SampleFileChannel& channel : channels)
    if (channel.name == slot && !channel.slot.empty())
      reject(path, fmt::format("has nothing left for {0}: its channel {0} is read as {1}; name another for one of them "
                               "with --map {0}=CHANNEL or --map {1}=CHANNEL",
                               slot, channel.slot));
}

}  // namespace

Window window_of(const std::string& path, const char* attribute, const Corners& corners, std::int64_t limit) {
  // 64 bits: damaged corners may lie 2^32 pixels apart.
  const std::int64_t width = corners.max_x - corners.min_x + 1, height = corners.max_y - corners.min_y + 1;
  if (width < 1 || height < 1 || width > limit || height > limit)
    reject(path, fmt::format("has a {} of {} x {} pixels, expected 1 to {} on each side; the header is damaged or the "
                             "frame must be rendered in parts",
                             attribute, width, height, limit));
  constexpr std::int64_t farthest = std::numeric_limits<std::int32_t>::max() / 2;  // OpenEXR's own limit
  for (const std::int64_t corner : {corners.min_x, corners.min_y, corners.max_x, corners.max_y})
    if (corner <= -farthest || corner >= farthest)
      reject(path, fmt::format("has a {} with a corner at {}, but OpenEXR knows coordinates up to {}; the header is "
                               "damaged or the frame must be moved",
                               attribute, corner, farthest));
  return {static_cast<int>(corners.min_x), static_cast<int>(corners.min_y), static_cast<int>(width),
          static_cast<int>(height)};
}

void check_storage(const std::string& path, const DeepHeader& header) {
  // Also channels that are not used: OpenEXR itself reads no deep file that has one.
  for (const HeaderChannel& channel : header.channels)
    if (channel.x_sampling != 1 || channel.y_sampling != 1)
      reject(path, fmt::format("stores channel {} subsampled by {} x {}, but every sample needs its own value; write "
                               "the channel with sampling 1 x 1",
                               channel.name, channel.x_sampling, channel.y_sampling));
  if (header.compression != "none" && header.compression != "rle" && header.compression != "zips")
    reject(path, fmt::format("has compression {}, but deep files have none, rle or zips; write it with zips",
                             header.compression));
  const std::int64_t rows = header.data.max_y - header.data.min_y + 1;
  if (header.chunk_count && *header.chunk_count != rows)
    reject(path, fmt::format("is damaged: chunkCount is {}, but the data window has {} rows; copy or render the file "
                             "again",
                             *header.chunk_count, rows));
}

void check_marker(const std::string& path, const DeepHeader& header, const std::vector<SampleFileChannel>& channels) {
  if (header.format && *header.format != format_value)
    reject(path, fmt::format("has the attribute {}={}, expected {}; convert it with the program that wrote it",
                             format_attribute, *header.format, format_value));
  if (header.version && *header.version != format_version)
    reject(path, fmt::format("has {} {:g}, but this program reads version {}; update the program or write that version",
                             version_attribute, *header.version, format_version));
  // Files from before the marker was settled have only their channels to show.
  const bool marked = std::any_of(channels.begin(), channels.end(),
                                  [](const SampleFileChannel& channel) { return marks_samples(channel.slot); });
  if (!header.format && !marked)
    reject(path, fmt::format("holds depth-composited deep data (channels {}), not Monte Carlo samples: it has neither "
                             "the attribute {}=\"{}\" nor film. or random. channels; render a sample file as "
                             "docs/file-format.md shows",
                             channel_names(channels), format_attribute, format_value));
}

void check_slots(const std::string& path, const std::vector<SampleFileChannel>& channels) {
  for (const std::string slot : {"R", "G", "B", "film.X", "film.Y"}) {
    const auto fills = [&](const SampleFileChannel& channel) { return channel.slot == slot; };
    if (std::any_of(channels.begin(), channels.end(), fills)) continue;
    check_not_taken(path, channels, slot);
    reject(path, fmt::format("has no channel for {0} ({1}); write a channel {0} or name it with --map {0}=CHANNEL "
                             "(the file has {2})",
                             slot, meaning(slot), channel_names(channels)));
  }
  for (const SampleFileChannel& channel : channels)
    if (!channel.slot.empty() && channel.type == PixelType::unsigned_int)
      reject(path, fmt::format("stores channel {} as integers, but slot {} needs half or float; write it as float or "
                               "leave it out with --map {}=",
                               channel.name, channel.slot, channel.slot));
}

}  // namespace rpf::io
