// The layers of a network (docs/network.md, "Layers").
#pragma once

#include <cstddef>
#include <vector>

#include "learned/network.h"

namespace rpf {

/// Values side by side for every cell of a level: [y][x][channels].
struct Field {
  int width = 0, height = 0;
  std::size_t channels = 0;
  std::vector<float> values;

  Field() = default;
  Field(int w, int h, std::size_t c)
      : width(w), height(h), channels(c), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * c) {}
  float* at(int x, int y) { return values.data() + offset(x, y); }
  const float* at(int x, int y) const { return values.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * channels;
  }
};

/// What a convolution reads: the channels of one field, then those of the next.
struct Source {
  const Field* field = nullptr;
  int halvings = 0;  ///< 1: of the level below, doubled by repetition
};

/// Outputs first .. first + count - 1 of a dense layer. For out[o] the inputs come in turn: fma(x[i], weight, out[o]).
void dense(const NetworkLayer& layer, const float* x, int first, int count, float* out);

void activate(float* values, int count);

/// One row of a 3x3 convolution, activated. Coordinates are clamped to the field.
void convolve_row(const NetworkLayer& layer, const std::vector<Source>& sources, int y, Field& out);

/// One row of the means of 2x2 cells, those that exist.
void halve_row(const Field& in, int y, Field& out);

}  // namespace rpf
