#include "cli/picture.h"

#include <algorithm>

namespace rpf::cli {
namespace {

constexpr int gap = 8;
constexpr int comfortable_width = 400;  ///< a smaller image is enlarged to about this

/// Column of a channel by name, its position in R, G, B where the name is missing.
std::size_t column(const Image& image, const char* name, std::size_t otherwise) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), name);
  return found != image.channels.end() ? static_cast<std::size_t>(found - image.channels.begin())
                                       : otherwise % image.channel_count();
}

void paste(const Image& source, int zoom, int left, Image& target) {
  const std::size_t columns[3] = {column(source, "R", 0), column(source, "G", 1), column(source, "B", 2)};
  const int width = source.data_window.width, height = source.data_window.height;
  for (int y = 0; y < height * zoom; ++y)
    for (int x = 0; x < width * zoom; ++x) {
      const float* from = source.pixel(static_cast<std::size_t>(y / zoom) * width + x / zoom);
      float* to = target.pixel(static_cast<std::size_t>(y) * target.data_window.width + left + x);
      for (int c = 0; c < 3; ++c) to[c] = from[columns[c]];
    }
}

}  // namespace

Image side_by_side(const std::vector<Image>& images) {
  const Window& size = images.front().data_window;
  const int zoom = std::clamp(comfortable_width / size.width, 1, 4);
  const int count = static_cast<int>(images.size());
  Image result;
  result.channels = {"R", "G", "B"};
  result.data_window = {0, 0, count * size.width * zoom + (count - 1) * gap, size.height * zoom};
  result.display_window = result.data_window;
  result.pixels.assign(result.data_window.pixel_count() * 3, 1.0F);
  for (int i = 0; i < count; ++i)
    paste(images[static_cast<std::size_t>(i)], zoom, i * (size.width * zoom + gap), result);
  return result;
}

}  // namespace rpf::cli
