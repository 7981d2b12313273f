#include "test_networks.h"

#include <cmath>
#include <fstream>

#include "learned/network_file.h"
#include "rpf_network.h"
#include "test_frames.h"

namespace rpf::test {
namespace {

/// Uniform with the deviation that keeps the size of what leaky activations pass on.
void fill(NetworkLayer& layer, float gain, Dice& dice) {
  const float fan_in = static_cast<float>(layer.inputs * layer.taps);
  const float limit = gain * std::sqrt(3 * 2 / 1.01F / fan_in);
  layer.weights.resize(static_cast<std::size_t>(layer.taps * layer.inputs * layer.outputs));
  for (float& w : layer.weights) w = limit * (2 * dice() - 1);
  layer.bias.assign(static_cast<std::size_t>(layer.outputs), 0.0F);
}

}  // namespace

Network random_network(const NetworkOptions& o) {
  Network n{o.shape, "random", "", layers_of(o.shape)};
  Dice dice(o.seed);
  for (NetworkLayer& layer : n.layers)
    fill(layer, o.gain * (layer.name == "head" ? 0.3F : layer.name == "weight2" ? 0.1F : 1), dice);
  NetworkLayer& head = n.layers[n.layers.size() - 3];
  const auto embedding = static_cast<kernel::uint>(o.shape.embedding), passes = static_cast<kernel::uint>(n.passes());
  for (kernel::uint pass = 0; pass < passes; ++pass)
    for (kernel::uint k = 0; k < RPF_GUIDES; ++k)
      head.bias[kernel::rpf_head_pass(pass, embedding) + embedding + 1 + k] = 0.5F;
  return parse_network(network_bytes(n), "random");  // weights that a file can hold
}

std::string write_network(const Network& network, const std::string& path) {
  const std::string bytes = network_bytes(network);
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

}  // namespace rpf::test
