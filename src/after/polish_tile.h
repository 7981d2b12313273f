// The work of polish() on one tile: planes of the tile's surroundings and sums over its rows, one offset at a time.
#pragma once

#include <vector>

#include "after/polish.h"
#include "plan/regions.h"

namespace rpf {

/// The variables of the records that guard edges: the modeled components of N and albedo.
std::vector<std::size_t> polish_guides(const Variables& variables);

/// Scratch that a thread reuses from tile to tile.
class PolishTile {
 public:
  /// Largest tile: all planes of one stay in the second cache.
  static constexpr int most_width = 256, most_height = 16;

  PolishTile(const Frame& frame, const Plan& plan, float floor);

  /// Polishes a tile (frame coordinates) of `pixels` into `result`, both [pixel][carried].
  void run(const Window& tile, const std::vector<float>& pixels, std::vector<float>& result);

  static std::uint64_t bytes(const Plan& plan);

 private:
  /// One value a pixel of the tile and what it reads around it: x from -polish_reach to width + polish_reach - 1.
  class Plane {
   public:
    static constexpr int stride = most_width + 2 * polish_reach, rows = most_height + 2 * polish_reach;
    float* row(int y) { return values_.data() + (y + polish_reach) * stride + polish_reach; }
    void fill(float value) { values_.assign(values_.size(), value); }

   private:
    std::vector<float> values_ = std::vector<float>(std::size_t{stride} * rows);
  };
  /// A row of patch sums, x from 0; three follow each other.
  struct PatchRow {
    float difference[Plane::stride], places[Plane::stride];
  };

  void load(const std::vector<float>& pixels);
  void load_guides(int x, int y, std::size_t pixel);
  void add_offset(int dx, int dy);
  void sum_patches_of_row(int y, int dx, int dy);
  void weigh_row(int y, int dx, int dy);
  void store(const std::vector<float>& pixels, std::vector<float>& result);

  const Frame& frame_;
  std::size_t carried_;
  float floor_, scale_;  ///< scale_: 1 / (2 H^2), by the three channels
  std::vector<std::size_t> guides_;
  Window tile_;
  std::vector<Plane> values_;                  ///< [carried]
  Plane valid_;                                ///< 1 where a pixel has samples, else 0, also outside the image
  std::vector<Plane> mean_, variance_;         ///< [guide] of the pixel's samples, and of that mean
  Plane weight_sum_;                           ///< of the weights
  std::vector<Plane> sums_;                    ///< [carried] of the weighted differences to the pixel's own value
  PatchRow patch_rows_[2 * polish_patch + 1];  ///< row y is at (y + 1) mod 3
};

}  // namespace rpf
