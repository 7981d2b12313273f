#include "learned/network.h"

#include <algorithm>
#include <string>

#include "rpf_network.h"

namespace rpf {
namespace {

NetworkLayer layer(std::string name, int inputs, int outputs, int taps) {
  return {std::move(name), inputs, outputs, taps, {}, {}};
}

}  // namespace

std::vector<NetworkLayer> layers_of(int sample_features, const std::vector<int>& channels, int embedding) {
  const int s = sample_features, last = static_cast<int>(channels.size()) - 1;
  const auto c = [&](int level) { return channels[static_cast<std::size_t>(level)]; };
  const auto name = [](const char* way, int level, const char* which) { return way + std::to_string(level) + which; };
  std::vector<NetworkLayer> layers = {layer("sample1", RPF_INPUTS, s, 1), layer("sample2", s, s, 1),
                                      layer("enter", 2 * s + RPF_STATISTICS, c(0), 1), layer("down0", c(0), c(0), 9)};
  for (int l = 1; l <= last; ++l) {
    layers.push_back(layer(name("down", l, "a"), c(l - 1), c(l), 9));
    layers.push_back(layer(name("down", l, "b"), c(l), c(l), 9));
  }
  for (int l = last - 1; l >= 0; --l) {
    layers.push_back(layer(name("up", l, "a"), c(l + 1) + c(l), c(l), 9));
    layers.push_back(layer(name("up", l, "b"), c(l), c(l), 9));
  }
  layers.push_back(
      layer("head", c(0), static_cast<int>(kernel::rpf_head_values(static_cast<kernel::uint>(embedding))), 1));
  layers.push_back(layer("weight1", s + RPF_CONTEXT, RPF_WEIGHT_FEATURES, 1));
  layers.push_back(layer("weight2", RPF_WEIGHT_FEATURES, 1, 1));
  return layers;
}

NetworkLayer with_inputs(const NetworkLayer& layer, const std::vector<int>& inputs) {
  NetworkLayer some{layer.name, static_cast<int>(inputs.size()), layer.outputs, layer.taps, {}, layer.bias};
  for (const int input : inputs) {
    const auto first = layer.weights.begin() + static_cast<std::ptrdiff_t>(input) * layer.outputs;
    some.weights.insert(some.weights.end(), first, first + layer.outputs);
  }
  return some;
}

int network_reach(int levels) {
  int passes = 0;
  for (kernel::uint p = 0; p < RPF_COLOR_PASSES; ++p) passes += RPF_PASS_REACH * kernel::rpf_dilation(p);
  // Cells of each level that its last convolution is read at, beyond those of the region; a cell of the level below
  // covers two, of which the other may be on either side.
  std::vector<int> needed = {passes};
  for (int l = 1; l < levels; ++l) needed.push_back((needed.back() + 2) / 2 + 1);
  int reach = needed.back() + 2 * (levels > 1 ? 1 : 0);  // what the lowest level's first convolution reads
  for (int l = levels - 2; l >= 0; --l)
    reach = std::max(2 * reach + 1, needed[static_cast<std::size_t>(l)] + 2) + (l > 0 ? 2 : 1);
  return levels > 1 ? reach : passes + 1;
}

}  // namespace rpf
