#include "run/picture.h"

#include <algorithm>

namespace rpf {
namespace {

/// Copies some of the carried channels of the crop into an image, undoing the radiance scale for the color.
Image image_of(const Pixels& pixels, const PreparedFrame& prepared, const Image& geometry, std::size_t first,
               std::size_t last) {
  const FrameFacts& facts = prepared.facts;
  Image image = geometry;
  image.channels.assign(prepared.carried_names.begin() + static_cast<std::ptrdiff_t>(first),
                        prepared.carried_names.begin() + static_cast<std::ptrdiff_t>(last));
  image.pixels.reserve(facts.crop.pixel_count() * image.channel_count());
  for (int y = facts.crop.y; y < facts.crop.y + facts.crop.height; ++y)
    for (int x = facts.crop.x; x < facts.crop.x + facts.crop.width; ++x)
      for (std::size_t c = first; c < last; ++c) {
        const float value = pixels[(static_cast<std::size_t>(y) * facts.width + x) * facts.carried + c];
        image.pixels.push_back(c < 3 ? value / prepared.facts.radiance_scale : value);
      }
  return image;
}

/// Channels of the image proper: R, G, B, and A where there is one. The features follow.
std::size_t color_channels(const PreparedFrame& prepared) {
  const auto& names = prepared.carried_names;
  return names.size() > 3 && names[3] == "A" ? 4 : 3;
}

}  // namespace

void add_energy(const Pixels& pixels, const FrameFacts& facts, int first_row, int end_row, double& sum) {
  const Window& crop = facts.crop;
  for (int y = std::max(first_row, crop.y); y < std::min(end_row, crop.y + crop.height); ++y)
    for (int x = crop.x; x < crop.x + crop.width; ++x) {
      const float* pixel = pixels.data() + (static_cast<std::size_t>(y - first_row) * facts.width + x) * facts.carried;
      sum += static_cast<double>(pixel[0]) + pixel[1] + pixel[2];
    }
}

double energy(const Pixels& pixels, const FrameFacts& facts) {
  double sum = 0;
  add_energy(pixels, facts, 0, facts.height, sum);
  return sum;
}

double share_of_energy(double kept, double plain) { return kept == plain ? 1 : kept / plain; }

void make_images(const Pixels& pixels, const PreparedFrame& prepared, const Image& geometry, Result& result) {
  const std::size_t colors = color_channels(prepared), all = prepared.carried_names.size();
  result.image = image_of(pixels, prepared, geometry, 0, colors);
  if (all > colors) result.features = image_of(pixels, prepared, geometry, colors, all);
}

}  // namespace rpf
