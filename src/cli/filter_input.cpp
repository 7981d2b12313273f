#include "cli/filter_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/method_options.h"
#include "rpf/error.h"
#include "rpf/presets.h"

namespace rpf::cli {
namespace {

SampleFileInfo info_of(const std::string& path, const Image& header, const SampleLayout& layout) {
  SampleFileInfo info;
  info.path = path;
  info.data_window = header.data_window;
  info.display_window = header.display_window;
  for (const std::string& slot : layout.slots) info.channels.push_back({slot, slot, PixelType::full_float});
  for (const std::string& channel : header.channels)
    if (header.channel_count() > 1 && !layout.find(channel))
      info.channels.push_back({channel, "", PixelType::full_float});
  info.value_bits = header.value_bits;
  info.dropped_attributes = header.dropped;
  info.sample_count = header.data_window.pixel_count();
  info.min_samples = info.max_samples = 1;
  return info;
}

}  // namespace

FilterInput open_input(const std::string& path, Method method, const SampleReadOptions& options) {
  if (!filters_images(method) || is_sample_file(path)) return {inspect_samples(path, options), 0};
  if (!options.slot_map.empty())
    throw Error(ErrorKind::usage,
                fmt::format("--map: \"{}\" is an image; only the channels of samples have slots", path));
  const Image header = inspect_image(path);
  const SampleLayout layout = layout_of_image(header);
  const std::uint64_t samples =
      header.data_window.pixel_count() * (layout.size() * sizeof(float) + sizeof(std::uint32_t));
  return {info_of(path, header, layout), image_bytes(header) + samples};
}

std::vector<std::string> files_read(const FilterOptions& options) {
  std::vector<std::string> files{options.input};
  const std::vector<PresetInfo> known = presets();
  const auto is_it = [&](const PresetInfo& preset) { return preset.name == options.settings.model; };
  if (std::none_of(known.begin(), known.end(), is_it)) files.push_back(options.settings.model);
  if (!options.facts.empty()) files.push_back(options.facts);
  return files;
}

SampleBuffer read_input(const FilterInput& input, const SampleReadOptions& options) {
  if (!input.is_image()) return read_samples(input.info.path, options);
  return samples_of_image(read_image(input.info.path, options.max_memory));
}

}  // namespace rpf::cli
