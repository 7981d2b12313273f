// Networks with random weights: of any shape, and not trained for anything.
#pragma once

#include <cstdint>
#include <memory>

#include "learned/network.h"

namespace rpf {

/// Weights are large enough that values neither vanish nor all saturate on the way through the layers.
std::shared_ptr<const Network> random_network(std::uint32_t seed, const NetworkShape& shape);

}  // namespace rpf
