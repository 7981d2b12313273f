// Networks for the tests, the same on every machine.
#pragma once

#include <cstdint>
#include <string>

#include "learned/network.h"

namespace rpf::test {

struct NetworkOptions {
  NetworkShape shape = {8, {8, 12, 16}, 4};
  std::uint32_t seed = 1;
  float gain = 1;  ///< weights times this: 1 keeps the size of what passes through
};

/// Random weights as training starts from: a moderate filter that the features guide.
Network random_network(const NetworkOptions& options = {});

/// Writes its file and returns the path; all weights are then those of the file.
std::string write_network(const Network& network, const std::string& path);

}  // namespace rpf::test
