#include "frame/lost_pixels.h"

#include <algorithm>
#include <array>

namespace rpf {
namespace {

using Color = std::array<float, 3>;
enum class State : char { unknown, waiting, known };

/// A color for every pixel, from those that have one to those that have none.
class Spreading {
 public:
  Spreading(const SampleBuffer& samples, const Columns& columns, const std::vector<std::size_t>& lost)
      : width_(samples.data_window.width),
        height_(samples.data_window.height),
        colors_(samples.data_window.pixel_count()),
        states_(colors_.size(), State::unknown) {
    for (std::size_t pixel = 0; pixel < colors_.size(); ++pixel) {
      const bool has_color = samples.first_sample[pixel] < samples.first_sample[pixel + 1] &&
                             !std::binary_search(lost.begin(), lost.end(), pixel);
      if (!has_color) continue;
      colors_[pixel] = mean_of(samples, columns, pixel);
      states_[pixel] = State::known;
    }
  }

  /// Returns whether any pixel had a color.
  bool run() {
    std::vector<std::size_t> ring;
    for (std::size_t pixel = 0; pixel < colors_.size(); ++pixel)
      if (states_[pixel] == State::known) await_neighbors(pixel, ring);
    const bool any = std::count(states_.begin(), states_.end(), State::known) > 0;
    while (!ring.empty()) ring = next_ring(ring);
    return any;
  }

  const Color& color(std::size_t pixel) const { return colors_[pixel]; }

 private:
  static Color mean_of(const SampleBuffer& samples, const Columns& columns, std::size_t pixel) {
    Color mean{};
    const std::uint32_t begin = samples.first_sample[pixel], end = samples.first_sample[pixel + 1];
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::uint32_t i = begin; i < end; ++i) sum += static_cast<double>(samples.record(i)[columns.color[c]]);
      mean[c] = static_cast<float>(sum / (end - begin));
    }
    return mean;
  }

  template <class Use>
  void for_each_neighbor(std::size_t pixel, Use use) const {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width_)),
              y = static_cast<int>(pixel / static_cast<std::size_t>(width_));
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height_ - 1); ++ny)
      for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width_ - 1); ++nx)
        if (nx != x || ny != y) use(static_cast<std::size_t>(ny) * static_cast<std::size_t>(width_) + nx);
  }

  void await_neighbors(std::size_t pixel, std::vector<std::size_t>& ring) {
    for_each_neighbor(pixel, [&](std::size_t neighbor) {
      if (states_[neighbor] != State::unknown) return;
      states_[neighbor] = State::waiting;
      ring.push_back(neighbor);
    });
  }

  std::vector<std::size_t> next_ring(const std::vector<std::size_t>& ring) {
    for (const std::size_t pixel : ring) {
      std::array<double, 3> sum{};
      int count = 0;
      for_each_neighbor(pixel, [&](std::size_t neighbor) {
        if (states_[neighbor] != State::known) return;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(colors_[neighbor][c]);
        ++count;
      });
      for (std::size_t c = 0; c < 3; ++c) colors_[pixel][c] = static_cast<float>(sum[c] / count);
    }
    std::vector<std::size_t> next;
    for (const std::size_t pixel : ring) states_[pixel] = State::known;
    for (const std::size_t pixel : ring) await_neighbors(pixel, next);
    return next;
  }

  int width_, height_;
  std::vector<Color> colors_;  ///< [pixel]
  std::vector<State> states_;  ///< [pixel]
};

}  // namespace

bool fill_lost_pixels(SampleBuffer& samples, const Columns& columns, const std::vector<std::size_t>& lost) {
  Spreading spreading(samples, columns, lost);
  if (!spreading.run()) return false;
  for (const std::size_t pixel : lost)
    for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 1]; ++i)
      for (std::size_t c = 0; c < 3; ++c) samples.record(i)[columns.color[c]] = spreading.color(pixel)[c];
  return true;
}

}  // namespace rpf
