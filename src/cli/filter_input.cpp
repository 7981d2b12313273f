#include "cli/filter_input.h"

#include <fmt/format.h>

#include "cli/method_options.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

SampleFileInfo info_of(const std::string& path, const Image& image, const SampleBuffer& samples) {
  SampleFileInfo info;
  info.path = path;
  info.data_window = samples.data_window;
  info.display_window = samples.display_window;
  for (const std::string& slot : samples.layout.slots) info.channels.push_back({slot, slot, PixelType::full_float});
  for (const std::string& channel : image.channels)
    if (image.channel_count() > 1 && !samples.layout.find(channel))
      info.channels.push_back({channel, "", PixelType::full_float});
  info.value_bits = image.value_bits;
  info.dropped_attributes = image.dropped;
  info.sample_count = samples.sample_count();
  info.min_samples = info.max_samples = 1;
  return info;
}

}  // namespace

FilterInput open_input(const std::string& path, Method method, const SampleReadOptions& options) {
  if (!filters_images(method) || is_sample_file(path)) return {inspect_samples(path, options), {}};
  if (!options.slot_map.empty())
    throw Error(ErrorKind::usage,
                fmt::format("--map: \"{}\" is an image; only the channels of samples have slots", path));
  FilterInput input;
  const Image image = read_image(path);
  input.image = samples_of_image(image);
  input.info = info_of(path, image, *input.image);
  return input;
}

}  // namespace rpf::cli
