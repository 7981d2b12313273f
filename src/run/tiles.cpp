#include "run/tiles.h"

#include <algorithm>

#include "run/progress_meter.h"

namespace rpf {
namespace {

/// Cuts a region into tiles of about `pixels` pixels: bands of whole rows, or parts of a row. Inside the region blocks
/// of pixels that share statistics stay whole, for a part of one costs as much as all of it.
std::vector<Window> cut(const Window& region, std::size_t pixels, int block) {
  const auto whole_blocks = [&](std::size_t length) {
    return static_cast<int>(std::max<std::size_t>(length / static_cast<std::size_t>(block), 1)) * block;
  };
  std::vector<Window> tiles;
  const int end_x = region.x + region.width, end_y = region.y + region.height;
  const int width = whole_blocks(std::min<std::size_t>(pixels / block, region.width + block));
  const int height = whole_blocks(pixels / std::min(width, region.width));
  for (int y = region.y / block * block; y < end_y; y += height)
    for (int x = region.x / block * block; x < end_x; x += width) {
      const int left = std::max(x, region.x), top = std::max(y, region.y);
      tiles.push_back({left, top, std::min(x + width, end_x) - left, std::min(y + height, end_y) - top});
    }
  return tiles;
}

}  // namespace

std::vector<Window> cut_into_tiles(const Plan& plan, int pass, const Control& control, int threads) {
  const PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  const std::size_t pixels = control.tile_pixels > 0 ? control.tile_pixels : tile_pixels(p, threads);
  return cut(p.region, pixels, plan.statistics_block);
}

}  // namespace rpf
