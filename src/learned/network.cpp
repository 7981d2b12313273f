#include "learned/network.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "rpf_network.h"

namespace rpf {
namespace {

NetworkLayer layer(std::string name, int inputs, int outputs, int taps) {
  return {std::move(name), inputs, outputs, taps, {}, {}};
}

}  // namespace

std::vector<NetworkLayer> layers_of(const NetworkShape& shape) {
  using kernel::uint;
  const int s = shape.sample_features, last = shape.levels() - 1;
  const auto c = [&](int level) { return shape.channels[static_cast<std::size_t>(level)]; };
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
  const uint head = kernel::rpf_head_pass(static_cast<uint>(shape.passes()), static_cast<uint>(shape.embedding));
  layers.push_back(layer("head", c(0), static_cast<int>(head), 1));
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

int pass_reach(const NetworkShape& shape) {
  const auto reach = [](const std::vector<int>& dilations) {
    return RPF_PASS_REACH * std::accumulate(dilations.begin(), dilations.end(), 0);
  };
  return std::max(reach(shape.dilations), reach(shape.albedo_dilations));
}

int network_reach(const NetworkShape& shape) {
  const int passes = pass_reach(shape), levels = shape.levels();
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
