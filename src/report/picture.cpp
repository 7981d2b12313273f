#include "report/picture.h"
#include "report/palette.h"

#include <algorithm>
#include <array>

namespace rpf::report {
namespace {

constexpr int comfortable_width = 400;  ///< a smaller image is enlarged to about this
constexpr int widest_row = 4000;        ///< a wider row is shrunk to about this
constexpr int line_width = 2;

using Columns = std::array<std::size_t, 3>;

/// A pixel becomes enlarge x enlarge, or shrink x shrink pixels become one. One of the two is 1.
struct Scale {
  int enlarge = 1, shrink = 1;

  int before(int position) const { return position * enlarge / shrink; }  ///< pixels that are wholly before it
  int length(int pixels) const { return (pixels * enlarge + shrink - 1) / shrink; }
};

Scale scale_of(const Window& size, int count) {
  const int row = count * size.width;
  if (row > widest_row) return {1, (row + widest_row - 1) / widest_row};
  return {std::clamp(comfortable_width / size.width, 1, 4), 1};
}

/// Column of a channel by name, its position in R, G, B where the name is missing.
std::size_t column(const Image& image, const char* name, std::size_t otherwise) {
  return image.find(name).value_or(otherwise % image.channel_count());
}

/// Mean of the pixels of `part` in a square; its first pixel lies in the part.
float mean_of_square(const Image& source, std::size_t channel, int left, int top, int side, const Window& part) {
  float sum = 0;
  int count = 0;
  for (int y = top; y < std::min(top + side, part.y + part.height); ++y)
    for (int x = left; x < std::min(left + side, part.x + part.width); ++x, ++count)
      sum += source.pixel(static_cast<std::size_t>(y) * source.data_window.width + x)[channel];
  return sum / static_cast<float>(count);
}

void paste(const Image& source, const Window& part, const Scale& scale, int left, int top, Image& target) {
  const Columns columns = {column(source, "R", 0), column(source, "G", 1), column(source, "B", 2)};
  for (int y = 0; y < scale.length(part.height); ++y)
    for (int x = 0; x < scale.length(part.width); ++x) {
      float* to = target.pixel(static_cast<std::size_t>(top + y) * target.data_window.width + left + x);
      for (std::size_t c = 0; c < 3; ++c)
        to[c] = mean_of_square(source, columns[c], part.x + x * scale.shrink / scale.enlarge,
                               part.y + y * scale.shrink / scale.enlarge, scale.shrink, part);
    }
}

/// A frame around the crop, moved inside where it would leave its image.
void draw_outline(const Window& size, const Window& crop, const Scale& scale, int image_left, Image& target) {
  const int left = std::max(scale.before(crop.x) - line_width, 0), top = std::max(scale.before(crop.y) - line_width, 0);
  const int right = std::min(scale.length(crop.x + crop.width) + line_width, scale.length(size.width));
  const int bottom = std::min(scale.length(crop.y + crop.height) + line_width, scale.length(size.height));
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const int to_edge = std::min({x - left, right - 1 - x, y - top, bottom - 1 - y});
      if (to_edge < line_width)
        std::copy(mark_color.begin(), mark_color.end(),
                  target.pixel(static_cast<std::size_t>(y) * target.data_window.width + image_left + x));
    }
}

/// As wide as the image above it allows, and at most twice as high: a narrow crop would become a tower.
Scale magnification(const Window& size, const Window& crop, const Scale& scale) {
  const int factor = std::min(scale.length(size.width) / crop.width, 2 * scale.length(size.height) / crop.height);
  return factor > 0 ? Scale{factor, 1} : scale;
}

}  // namespace

Image plain_picture(int width, int height, float value) {
  Image image;
  image.channels = {"R", "G", "B"};
  image.data_window = image.display_window = {0, 0, width, height};
  image.pixels.assign(image.data_window.pixel_count() * 3, value);
  return image;
}

Image side_by_side(const std::vector<Image>& images, const std::optional<Window>& crop) {
  const Window& size = images.front().data_window;
  const int count = static_cast<int>(images.size());
  const Scale scale = scale_of(size, count);
  const int width = scale.length(size.width), height = scale.length(size.height);
  const Scale magnified = crop ? magnification(size, *crop, scale) : scale;
  Image result = plain_picture(count * width + (count - 1) * picture_gap,
                               height + (crop ? picture_gap + magnified.length(crop->height) : 0), 1);
  int left = 0;
  for (const Image& image : images) {
    paste(image, {0, 0, size.width, size.height}, scale, left, 0, result);
    if (crop) {
      draw_outline(size, *crop, scale, left, result);
      paste(image, *crop, magnified, left, height + picture_gap, result);
    }
    left += width + picture_gap;
  }
  return result;
}

}  // namespace rpf::report
