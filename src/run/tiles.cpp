#include "run/tiles.h"

#include <algorithm>

#include "run/progress_meter.h"

namespace rpf {
namespace {

/// Cuts a region into tiles of at most `pixels` pixels: bands of whole rows, or parts of a row.
std::vector<Window> cut(const Window& region, std::size_t pixels) {
  const int width = static_cast<int>(std::min<std::size_t>(region.width, pixels));
  const int height = static_cast<int>(std::min<std::size_t>(region.height, std::max<std::size_t>(pixels / width, 1)));
  std::vector<Window> tiles;
  for (int y = 0; y < region.height; y += height)
    for (int x = 0; x < region.width; x += width)
      tiles.push_back(
          {region.x + x, region.y + y, std::min(width, region.width - x), std::min(height, region.height - y)});
  return tiles;
}

}  // namespace

std::vector<Window> cut_into_tiles(const Plan& plan, int pass, const Window& part, const Control& control,
                                   int threads) {
  const PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  const std::size_t pixels = control.tile_pixels > 0 ? control.tile_pixels : tile_pixels(p, threads);
  return cut(part, pixels);
}

}  // namespace rpf
