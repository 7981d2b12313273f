#include "after/polish.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "after/polish_tile.h"

namespace rpf {
namespace {

constexpr double floor_of_mean = 0.05;

/// Tiles for each thread between two calls of PolishOptions::done: less than a tenth of a second.
constexpr std::size_t tiles_per_thread = 24;

std::vector<Window> tiles_of(const Window& region) {
  std::vector<Window> tiles;
  const int right = region.x + region.width, bottom = region.y + region.height;
  for (int y = region.y; y < bottom; y += PolishTile::most_height)
    for (int x = region.x; x < right; x += PolishTile::most_width)
      tiles.push_back(
          {x, y, std::min(PolishTile::most_width, right - x), std::min(PolishTile::most_height, bottom - y)});
  return tiles;
}

}  // namespace

float polish_floor(const Frame& frame, const std::vector<float>& pixels, std::size_t carried) {
  double sum = 0, count = 0;
  for (std::size_t pixel = 0; pixel + 1 < frame.first_sample.size(); ++pixel) {
    if (frame.samples(pixel) == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) sum += pixels[pixel * carried + c];
    count += 3;
  }
  return sum > 0 ? static_cast<float>(floor_of_mean * (sum / count)) : 0.0F;
}

void polish(const Frame& frame, const Plan& plan, const PolishOptions& options, std::vector<float>& pixels) {
  if (!(plan.polish > 0) || !(options.floor > 0)) return;
  const std::vector<Window> tiles = tiles_of(plan.polished);
  std::vector<float> result = pixels;
  const auto threads = static_cast<std::size_t>(options.threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);  // may be more than cores
  tbb::task_arena arena(options.threads);
  // Given as arguments, frame and plan would be copied: oneTBB keeps them for the next thread.
  tbb::enumerable_thread_specific<PolishTile> workspaces([&] { return PolishTile(frame, plan, options.floor); });
  const std::size_t step = tiles_per_thread * threads;
  for (std::size_t first = 0; first < tiles.size(); first += step) {
    const std::size_t last = std::min(first + step, tiles.size());
    arena.execute([&] {
      tbb::parallel_for(first, last, [&](std::size_t t) { workspaces.local().run(tiles[t], pixels, result); });
    });
    std::size_t done = 0;
    for (std::size_t t = first; t < last; ++t) done += tiles[t].pixel_count();
    if (options.done) options.done(done);
  }
  pixels = std::move(result);
}

std::uint64_t polish_bytes(const Plan& plan, int threads) {
  return plan.polish > 0 ? static_cast<std::uint64_t>(threads) * PolishTile::bytes(plan) : 0;
}

}  // namespace rpf
