// A network of the learned estimator as plain data (docs/network.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rpf {

/// Dense (taps = 1) or 3x3 (taps = 9).
struct NetworkLayer {
  std::string name;  ///< "sample1", "down1a", ...
  int inputs = 0, outputs = 0, taps = 1;
  std::vector<float> weights;  ///< [ky][kx][inputs][outputs]
  std::vector<float> bias;     ///< [outputs]
};

/// What a file says of a network beside its weights.
struct NetworkShape {
  int sample_features = 0;
  std::vector<int> channels;  ///< [level]
  int embedding = 0;
  std::vector<int> dilations = {8, 4, 2, 1};   ///< of the passes of the color, at least one
  std::vector<int> albedo_dilations = {2, 1};  ///< and of those of the albedo, whose numbers come behind

  int levels() const { return static_cast<int>(channels.size()); }
  int color_passes() const { return static_cast<int>(dilations.size()); }
  int passes() const { return color_passes() + static_cast<int>(albedo_dilations.size()); }
  int dilation(int pass) const {
    const bool is_of_color = pass < color_passes();
    return is_of_color ? dilations[static_cast<std::size_t>(pass)]
                       : albedo_dilations[static_cast<std::size_t>(pass - color_passes())];
  }
};

struct Network : NetworkShape {
  std::string name;
  std::string hash;                  ///< of the file: 16 hexadecimal digits
  std::vector<NetworkLayer> layers;  ///< in the order of the file

  const NetworkLayer& sample1() const { return layers[0]; }
  const NetworkLayer& sample2() const { return layers[1]; }
  const NetworkLayer& enter() const { return layers[2]; }
  /// The convolutions on the way down: one of level 0, two of every other; `second`: the one named b.
  const NetworkLayer& down(int level, bool second) const { return layers[down_index(level, second)]; }
  /// The convolutions on the way up, of every level but the last.
  const NetworkLayer& up(int level, bool second) const {
    return layers[static_cast<std::size_t>(3 + 2 * (levels() - 1) + 2 * (levels() - 2 - level) + (second ? 2 : 1))];
  }
  const NetworkLayer& head() const { return layers[layers.size() - 3]; }
  const NetworkLayer& weight1() const { return layers[layers.size() - 2]; }
  const NetworkLayer& weight2() const { return layers[layers.size() - 1]; }

  static std::size_t down_index(int level, bool second) {
    return static_cast<std::size_t>(level == 0 ? 3 : 2 + 2 * level + (second ? 1 : 0));
  }
};

/// The layers of a network of this shape, without weights.
std::vector<NetworkLayer> layers_of(const NetworkShape& shape);

/// The layer with some of its inputs only, dense, in this order: what it is where the others are 0.
NetworkLayer with_inputs(const NetworkLayer& layer, const std::vector<int>& inputs);

/// Pixels each way that a pixel of the result reads at most: passes and convolutions, and what cells aligned to the
/// frame add.
int network_reach(const NetworkShape& shape);
/// Of the passes alone: how far the samples are that it is made of.
int pass_reach(const NetworkShape& shape);

}  // namespace rpf
