// The passes of the learned estimator (docs/network.md, "Sums"): weighted means over 5x5 pixels at a dilation.
#pragma once

#include <cstddef>
#include <vector>

namespace rpf {

/// Rows of pixels, channel by channel: [y][channel][x]. Loops over the pixels of a row are what a compiler makes
/// vectors of.
struct Rows {
  int width = 0, height = 0;
  std::size_t channels = 0;
  std::vector<float> values;

  Rows() = default;
  Rows(int w, int h, std::size_t c)
      : width(w), height(h), channels(c), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * c) {}
  float* at(int y, std::size_t channel) { return values.data() + offset(y, channel); }
  const float* at(int y, std::size_t channel) const { return values.data() + offset(y, channel); }

 private:
  std::size_t offset(int y, std::size_t channel) const {
    return (static_cast<std::size_t>(y) * channels + channel) * static_cast<std::size_t>(width);
  }
};

/// What a pass weighs with.
struct PassWeights {
  Rows embedding;  ///< e_i
  Rows own;        ///< w_ii, one channel
};

/// Replaces row y of `in` by weighted means.
void filter_row(const PassWeights& weights, int dilation, const Rows& in, int y, Rows& out);

}  // namespace rpf
