// The plain means of pixels that have many samples, to which the learned estimator's results are drawn
// (docs/network.md, "Many samples").
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

  /// Gives each of the crop's pixels, all of which were added, its share of its mean.
  void draw_to_means(Pixels& pixels, float exposure) const;

 private:
  /// Of one row, or of all.
  struct Part {
    Pixels means;                   ///< [pixel that needs it][carried]
    std::vector<double> effective;  ///< [pixel that needs it] samples
  };
  Part part_of(int row) const;

  const PreparedFrame& prepared_;
  int threads_;
  Part all_;
};

}  // namespace rpf
