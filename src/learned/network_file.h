// Network files: one line of JSON, then the layers in binary16 (docs/network.md, "File").
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "learned/network.h"

namespace rpf {

/// Reads a network. `origin`: what errors call it. Throws Error(input) where it is not one as a whole: another format
/// or version, a shape beyond what is possible, missing or further bytes, a weight that is not finite.
Network parse_network(std::string_view bytes, const std::string& origin);

/// The bytes of a network as parse_network() reads them; weights are rounded to binary16 (toward zero).
std::string network_bytes(const Network& network);

/// The networks that the library carries: name and bytes.
struct EmbeddedNetwork {
  const char* name;
  std::string_view bytes;
};
const std::vector<EmbeddedNetwork>& embedded_networks();

/// The network of that name in the library; else the file of that name. Networks of the library are read once.
/// `max_memory`: as in Settings. Throws Error(usage) where there is neither, Error(input) as parse_network() does,
/// Error(memory) where a file takes more than that.
std::shared_ptr<const Network> find_network(const std::string& model, std::uint64_t max_memory = 0);

/// The value of a binary16 number, exactly.
float from_half(std::uint16_t half);

}  // namespace rpf
