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
  Spreading(const Window& data_window, const std::vector<PixelColor>& colors)
      : width_(data_window.width), height_(data_window.height), colors_(colors.size()), states_(colors.size()) {
    for (std::size_t pixel = 0; pixel < colors.size(); ++pixel) {
      colors_[pixel] = colors[pixel].mean;
      states_[pixel] = colors[pixel].is_known ? State::known : State::unknown;
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

ColorSum sum_of_colors(const SampleBuffer& rows, const Columns& columns, std::uint32_t begin, std::uint32_t end) {
  ColorSum sum;
  sum.samples = end - begin;
  for (std::uint32_t i = begin; i < end; ++i)
    for (std::size_t c = 0; c < 3; ++c) sum.color[c] += static_cast<double>(rows.record(i)[columns.color[c]]);
  return sum;
}

PixelColor mean_of(const ColorSum& sum) {
  PixelColor color;
  color.is_known = sum.samples > 0;
  const double share = 1.0 / std::max(sum.samples, 1U);
  for (std::size_t c = 0; c < 3; ++c) color.mean[c] = static_cast<float>(sum.color[c] * share);
  return color;
}

bool find_lost_colors(const Window& data_window, const std::vector<PixelColor>& colors, std::vector<LostPixel>& lost) {
  Spreading spreading(data_window, colors);
  if (!spreading.run()) return false;
  for (LostPixel& pixel : lost) pixel.color = spreading.color(pixel.pixel);
  return true;
}

}  // namespace rpf
