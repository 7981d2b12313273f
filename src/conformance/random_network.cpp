#include "conformance/random_network.h"

#include <cmath>

#include "numeric.h"

namespace rpf {
namespace {

/// Of a leaky layer: keeps the variance of what goes through it.
constexpr double gain = 2.4;

}  // namespace

std::shared_ptr<const Network> random_network(std::uint32_t seed, const NetworkShape& shape) {
  auto network = std::make_shared<Network>(Network{shape, "random", "", layers_of(shape)});
  std::uint32_t counter = 0;
  const auto signed_unit = [&] {
    const std::uint32_t word = kernel::rpf_hash(counter++, seed, 2).x;
    return static_cast<float>(word >> 8) / 8388608.0F - 1.0F;
  };
  for (NetworkLayer& layer : network->layers) {
    const auto scale = static_cast<float>(gain / std::sqrt(static_cast<double>(layer.taps) * layer.inputs));
    const std::size_t outputs = static_cast<std::size_t>(layer.outputs);
    layer.weights.resize(static_cast<std::size_t>(layer.taps) * static_cast<std::size_t>(layer.inputs) * outputs);
    for (float& weight : layer.weights) weight = scale * signed_unit();
    layer.bias.resize(outputs);
    for (float& bias : layer.bias) bias = 0.1F * signed_unit();
  }
  return network;
}

}  // namespace rpf
