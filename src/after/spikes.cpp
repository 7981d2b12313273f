#include "after/spikes.h"

#include <algorithm>

#include "after/resolve.h"
#include "plan/regions.h"

namespace rpf {
namespace {

/// What happens to the samples of a pixel: they are multiplied with `factor`, then `added` is added.
struct Change {
  float factor = 1;
  float added[3] = {0, 0, 0};
};

class Spreading {
 public:
  Spreading(const Frame& frame, const std::vector<float>& pixels, std::size_t carried)
      : frame_(frame), pixels_(pixels), carried_(carried), changes_(frame.first_sample.size() - 1) {
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) spread_if_spike(x, y);
  }

  void apply(std::vector<float>& colors) const {
    for (std::size_t pixel = 0; pixel < changes_.size(); ++pixel) {
      const Change& change = changes_[pixel];
      for (std::size_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          float& color = colors[i * carried_ + c];
          color = color * change.factor + change.added[c];
        }
    }
  }

 private:
  std::size_t pixel(int x, int y) const { return static_cast<std::size_t>(y) * frame_.width + x; }

  float brightness(std::size_t pixel) const {
    const float* mean = pixels_.data() + pixel * carried_;
    return mean[0] + mean[1] + mean[2];
  }

  /// Calls visit(pixel) for the pixels that have samples within so many pixels of a place, itself included.
  template <typename Visit>
  void around(int x, int y, int reach, const Visit& visit) const {
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, frame_.height - 1); ++v)
      for (int u = std::max(x - reach, 0); u <= std::min(x + reach, frame_.width - 1); ++u)
        if (frame_.samples(pixel(u, v)) > 0) visit(pixel(u, v));
  }

  /// How much of a pixel's light it keeps: less than 1 for a spike.
  float kept(int x, int y) const {
    const std::size_t center = pixel(x, y);
    bool alone = true;
    float brightest = 0;
    around(x, y, 1, [&](std::size_t neighbor) {
      if (neighbor == center) return;
      brightest = alone ? brightness(neighbor) : std::max(brightest, brightness(neighbor));
      alone = false;
    });
    const float own = brightness(center);
    return alone || !(own > 0) || !(own > brightest) ? 1.0F : std::max(brightest / own, 0.0F);
  }

  void spread_if_spike(int x, int y) {
    const std::size_t center = pixel(x, y);
    if (frame_.samples(center) == 0) return;
    const float factor = kept(x, y);
    if (factor == 1.0F) return;
    changes_[center].factor = factor;
    int receivers = 0;
    around(x, y, spike_spread, [&](std::size_t) { ++receivers; });
    const float share = (1.0F - factor) / static_cast<float>(receivers);
    around(x, y, spike_spread, [&](std::size_t receiver) {
      for (std::size_t c = 0; c < 3; ++c) changes_[receiver].added[c] += share * pixels_[center * carried_ + c];
    });
  }

  const Frame& frame_;
  const std::vector<float>& pixels_;
  std::size_t carried_;
  std::vector<Change> changes_;  ///< [pixel]
};

}  // namespace

void spread_spikes(const Frame& frame, std::size_t carried, std::vector<float>& colors) {
  const std::vector<float> pixels = resolve(frame, colors, carried);
  Spreading(frame, pixels, carried).apply(colors);
}

std::uint64_t spikes_bytes(std::uint64_t pixels) { return pixels * sizeof(Change); }

}  // namespace rpf
