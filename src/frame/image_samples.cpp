#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "rpf/error.h"
#include "rpf/samples.h"

namespace rpf {
namespace {

/// The channels that become R, G, B and, where there is one, A.
std::vector<std::size_t> color_columns(const Image& image) {
  if (image.channel_count() == 1) return {0, 0, 0};
  std::vector<std::size_t> columns;
  for (const char* name : {"R", "G", "B", "A"})
    if (const auto column = image.find(name)) columns.push_back(*column);
  if (image.find("R") && image.find("G") && image.find("B")) return columns;
  throw Error(ErrorKind::input, fmt::format("the image has channels {}; R, G and B are needed, or one channel alone",
                                            fmt::join(image.channels, ", ")));
}

}  // namespace

SampleLayout layout_of_image(const Image& image) {
  SampleLayout layout{{"R", "G", "B", "film.X", "film.Y"}};
  if (color_columns(image).size() > 3) layout.slots.emplace_back("A");
  return layout;
}

SampleBuffer samples_of_image(const Image& image) {
  const std::vector<std::size_t> columns = color_columns(image);
  SampleBuffer samples;
  samples.data_window = image.data_window;
  samples.display_window = image.display_window;
  samples.metadata = image.metadata;
  samples.layout = layout_of_image(image);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string& channel = image.channels[columns[c]];
    if (std::count(image.half_channels.begin(), image.half_channels.end(), channel) > 0)
      samples.half_slots.emplace_back(1, "RGB"[c]);
  }
  samples.first_sample = {0};
  samples.values.reserve(image.data_window.pixel_count() * samples.layout.size());
  for (std::uint32_t pixel = 0; pixel < image.data_window.pixel_count(); ++pixel) {
    const float* from = image.pixel(pixel);
    const int x = static_cast<int>(pixel) % image.data_window.width,
              y = static_cast<int>(pixel) / image.data_window.width;
    for (std::size_t c = 0; c < 3; ++c) samples.values.push_back(from[columns[c]]);
    samples.values.push_back(static_cast<float>(image.data_window.x + x) + 0.5F);
    samples.values.push_back(static_cast<float>(image.data_window.y + y) + 0.5F);
    if (columns.size() > 3) samples.values.push_back(from[columns[3]]);
    samples.first_sample.push_back(pixel + 1);
  }
  return samples;
}

}  // namespace rpf
