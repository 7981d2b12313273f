#include "learned/network_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "network_launch.h"
#include "rpf/error.h"
#include "rpf_network.h"

namespace rpf {
namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "rpf-network";
/// Of version 1 are networks whose passes are not said: those of a NetworkShape.
constexpr int format_version = 2;

// What a file may ask for, so that no shape overflows and none takes more than a few hundred MB.
constexpr std::size_t longest_header = 1 << 16, longest_name = 64, most_bytes = 1 << 28;
constexpr int most_features = 128, most_channels = 512, most_levels = 8, most_embedding = 64, most_passes = 8;
constexpr int largest_dilation = RPF_MARGIN / RPF_PASS_REACH;

[[noreturn]] void refuse(const std::string& origin, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("{}: {}; a network is made by training/ (docs/network.md)", origin, what));
}

int number_in(const Json& value, int largest, const std::string& what, const std::string& origin) {
  if (!value.is_number_integer() || value < 1 || value > largest)
    refuse(origin, fmt::format("'{}' must be a whole number from 1 to {}", what, largest));
  return value.get<int>();
}

std::vector<int> numbers_in(const Json& header, const char* name, int most_numbers, int largest,
                            const std::string& origin) {
  const Json list = header.value(name, Json());
  if (!list.is_array() || list.empty() || list.size() > static_cast<std::size_t>(most_numbers))
    refuse(origin, fmt::format("'{}' must be a list of 1 to {} numbers", name, most_numbers));
  std::vector<int> numbers;
  for (const Json& number : list) numbers.push_back(number_in(number, largest, name, origin));
  return numbers;
}

Json header_of(std::string_view bytes, const std::string& origin) {
  const std::size_t end = bytes.substr(0, longest_header).find('\n');
  if (end == std::string_view::npos) refuse(origin, "not a network file: no line of JSON at its beginning");
  Json header = Json::parse(bytes.substr(0, end), nullptr, false);
  if (!header.is_object() || header.value("format", Json()) != format_name)
    refuse(origin, "not a network file: its first line must be JSON with \"format\":\"rpf-network\"");
  const auto is_version = [&](int number) { return header.value("version", Json()) == number; };
  if (!is_version(1) && !is_version(format_version))
    refuse(origin, fmt::format("this version of rpf reads networks of version 1 to {}", format_version));
  return header;
}

/// It is shown to users and kept in images.
bool is_printable(const std::string& name) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  return !name.empty() && name.size() <= longest_name && std::none_of(name.begin(), name.end(), is_control);
}

/// Name and shape; the layers have no weights yet.
Network shape_of(const Json& header, const std::string& origin) {
  Network n;
  const Json name = header.value("name", Json());
  n.name = name.is_string() ? name.get<std::string>() : "";
  if (!is_printable(n.name)) refuse(origin, fmt::format("'name' must be a line of 1 to {} characters", longest_name));
  n.sample_features = number_in(header.value("sample_features", Json()), most_features, "sample_features", origin);
  n.embedding = number_in(header.value("embedding", Json()), most_embedding, "embedding", origin);
  n.channels = numbers_in(header, "channels", most_levels, most_channels, origin);
  if (header["version"] == format_version) {
    n.dilations = numbers_in(header, "dilations", most_passes, largest_dilation, origin);
    n.albedo_dilations = numbers_in(header, "albedo_dilations", most_passes, largest_dilation, origin);
  }
  n.layers = layers_of(n);
  return n;
}

std::size_t weight_count(const NetworkLayer& layer) {
  return static_cast<std::size_t>(layer.taps) * static_cast<std::size_t>(layer.inputs) *
         static_cast<std::size_t>(layer.outputs);
}

std::size_t value_count(const Network& network) {
  std::size_t sum = 0;
  for (const NetworkLayer& l : network.layers) sum += weight_count(l) + static_cast<std::size_t>(l.outputs);
  return sum;
}

/// Takes `count` numbers from the front of `bytes`.
std::vector<float> take(std::string_view& bytes, std::size_t count, const NetworkLayer& layer,
                        const std::string& origin) {
  std::vector<float> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto low = static_cast<unsigned char>(bytes[2 * i]), high = static_cast<unsigned char>(bytes[2 * i + 1]);
    values.push_back(from_half(static_cast<std::uint16_t>(low | high << 8)));
    if (!std::isfinite(values.back()))
      refuse(origin, fmt::format("layer {} has a weight that is not finite (number {})", layer.name, i));
  }
  bytes.remove_prefix(2 * count);
  return values;
}

/// FNV-1a, 64 bits: tells files apart, and does not protect from anybody.
std::string hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return fmt::format("{:016x}", hash);
}

std::uint16_t to_half(float value) {
  const float magnitude = std::fabs(value);
  const int exponent = magnitude > 0 ? std::max(std::ilogb(magnitude), -14) : -14;
  const int digits =
      static_cast<int>(std::ldexp(magnitude, 10 - exponent));  // of the significand, in units of its last
  const int bits = (exponent + 14) * 1024 + digits;
  return static_cast<std::uint16_t>(std::min(bits, 0x7bff) | (std::signbit(value) ? 0x8000 : 0));
}

/// `max_memory`: as in Settings, of the bytes and of the halves in them as floats.
std::string bytes_of_file(const std::string& path, std::uint64_t max_memory) {
  constexpr std::uint64_t held = 3;  // bytes for each of the file
  const std::uint64_t most = max_memory == 0 ? most_bytes : std::min<std::uint64_t>(most_bytes, max_memory / held);
  std::ifstream file(path, std::ios::binary);
  std::string bytes, part(1 << 16, '\0');
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0) {
    bytes.append(part, 0, static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > most_bytes) refuse(path, fmt::format("larger than {} bytes, which no network is", most_bytes));
    if (bytes.size() > most)
      throw Error(
          ErrorKind::memory,
          fmt::format("\"{}\": this network takes more than the limit of {:.0f} MB; raise --max-memory, or name "
                      "another network",
                      path, static_cast<double>(max_memory) / (1 << 20)));
  }
  return bytes;
}

}  // namespace

float from_half(std::uint16_t half) {
  const int exponent = half >> 10 & 31, digits = half & 1023;
  float value = 0;
  if (exponent == 31)
    value = digits == 0 ? INFINITY : NAN;
  else if (exponent == 0)
    value = std::ldexp(static_cast<float>(digits), -24);
  else
    value = std::ldexp(static_cast<float>(1024 + digits), exponent - 25);
  return (half & 0x8000) != 0 ? 0.0F - value : value;  // there is no -0: adding it would not be the same as nothing
}

Network parse_network(std::string_view bytes, const std::string& origin) {
  const Json header = header_of(bytes, origin);
  Network network = shape_of(header, origin);
  network.hash = hash_of(bytes);
  bytes.remove_prefix(bytes.find('\n') + 1);
  const std::size_t expected = 2 * value_count(network);
  if (bytes.size() != expected)
    refuse(origin, fmt::format("{} bytes of weights where its shape has {}", bytes.size(), expected));
  for (NetworkLayer& layer : network.layers) {
    layer.weights = take(bytes, weight_count(layer), layer, origin);
    layer.bias = take(bytes, static_cast<std::size_t>(layer.outputs), layer, origin);
  }
  return network;
}

std::string network_bytes(const Network& network) {
  const Json header = {{"format", format_name},          {"version", format_version},
                       {"name", network.name},           {"sample_features", network.sample_features},
                       {"channels", network.channels},   {"embedding", network.embedding},
                       {"dilations", network.dilations}, {"albedo_dilations", network.albedo_dilations}};
  std::string bytes = header.dump() + "\n";
  for (const NetworkLayer& layer : network.layers)
    for (const std::vector<float>* values : {&layer.weights, &layer.bias})
      for (const float value : *values) {
        const std::uint16_t half = to_half(value);
        bytes += {static_cast<char>(half & 255), static_cast<char>(half >> 8)};
      }
  return bytes;
}

std::shared_ptr<const Network> find_network(const std::string& model, std::uint64_t max_memory) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Network>> known;
  for (const EmbeddedNetwork& embedded : embedded_networks()) {
    if (model != embedded.name) continue;
    const std::lock_guard<std::mutex> lock(mutex);
    std::shared_ptr<const Network>& network = known[model];
    if (!network) network = std::make_shared<Network>(parse_network(embedded.bytes, model));
    return network;
  }
  if (std::ifstream(model).good())
    return std::make_shared<Network>(parse_network(bytes_of_file(model, max_memory), model));
  std::vector<std::string> names;
  for (const EmbeddedNetwork& embedded : embedded_networks()) names.emplace_back(embedded.name);
  throw Error(ErrorKind::usage,
              fmt::format("model '{}': neither a file that can be read nor one of {}", model, fmt::join(names, ", ")));
}

}  // namespace rpf
