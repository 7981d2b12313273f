// The random numbers of one pixel's samples.
#pragma once

#include <cstdint>

#include "rpf/scene.h"

namespace rpf::scene {

struct Pair {
  float u = 0, v = 0;  ///< [0, 1)
};

/// The random parameters of one sample. Everything after the first hit comes from a stream with the key `further`.
struct Draw {
  Pair film;  ///< position inside the pixel
  Pair lens, light, bsdf;
  float time = 0;
  std::uint32_t further = 0;
};

class PixelSampler {
 public:
  /// `count`: how many samples the pixel gets. `key`: differs from pixel to pixel.
  PixelSampler(SceneSampler kind, std::uint32_t key, std::uint32_t count) : kind_(kind), key_(key), count_(count) {}

  /// The numbers of sample 0 .. count - 1.
  Draw draw(std::uint32_t sample) const;
  /// The same for one pair of dimensions; pairs are independent of each other.
  Pair pair(std::uint32_t sample, std::uint32_t dimension) const;

 private:
  SceneSampler kind_;
  std::uint32_t key_, count_;
};

/// Element i of a random permutation of 0 .. count - 1 (Kensler, "Correlated Multi-Jittered Sampling", 2013).
std::uint32_t permute(std::uint32_t i, std::uint32_t count, std::uint32_t key);

}  // namespace rpf::scene
