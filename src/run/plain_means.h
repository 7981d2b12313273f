// The plain means of the pixels that the learned estimator filters: what the picture's energy is held against, and what
// pixels of many samples are drawn to (docs/network.md, "Many samples").
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/prepare.h"
#include "run/picture.h"

namespace rpf {

/// How much of a pixel's own mean is in its result: 0 for up to 45 samples, towards 1 with more of them, and less the
/// further result and mean are apart. `samples`: PixelWeights::effective_samples(). `carried` values each, of which the
/// first three, the radiance, count; `exposure`: the power of two that brings it to about 1.
double own_share(double samples, const float* result, const float* mean, float exposure);

/// A value with that share of its mean.
float drawn(float result, float mean, double share);

/// Whether pixels have so many samples that their means are kept: of equal weight they would have a share.
bool has_own_share(std::uint32_t samples);

class PlainMeans {
 public:
  /// `prepared` outlives this; its samples are needed while rows are added, on so many threads.
  PlainMeans(const PreparedFrame& prepared, int threads);

  /// The pixels of the crop in these rows, whose samples are in memory. Rows come in their order, each once.
  void add_rows(int first, int end);

  /// Sum of their components R, G and B.
  double energy() const { return all_.energy; }

  /// Gives each of the crop's pixels, all of which were added, its share of its mean.
  void draw_to_means(Pixels& pixels, float exposure) const;

 private:
  /// Of one row, or of all: energy is summed row by row, so that threads do not change it.
  struct Part {
    Pixels means;                   ///< [pixel that needs it][carried]
    std::vector<double> effective;  ///< [pixel that needs it] samples
    double energy = 0;
  };
  Part part_of(int row) const;

  const PreparedFrame& prepared_;
  int threads_;
  Part all_;
};

}  // namespace rpf
