#include "cli/origin.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/methods.h"
#include "rpf/model.h"
#include "rpf/version.h"

namespace rpf::cli {
namespace {

/// FNV-1a over words of 8 bytes, with a second multiplication that lets high bits reach low ones: for telling files
/// apart that nobody forged, as fast as they are read.
class Hash {
 public:
  void add(const char* data, std::size_t size) {
    for (std::size_t at = 0; at < size; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, data + at, std::min(size - at, sizeof word));
      value_ = (value_ ^ word) * 0x9E3779B97F4A7C15U;
      value_ ^= value_ >> 32;
    }
    size_ += size;
  }
  std::string text() const { return fmt::format("{:016x}", (value_ ^ size_) * 0x100000001B3U); }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U, size_ = 0;
};

std::string list(const std::optional<std::vector<std::string>>& names) {
  return names ? fmt::format("[{}]", fmt::join(*names, ",")) : "default";
}

/// Every field that can change a bit; neither backend nor threads can.
std::string text_of(const Settings& s) {
  const double none = -1;
  std::string text =
      fmt::format("{} {} {} {} [{}] {} {} {} {} {} {} {} {} {}", version(), name_of(s.method),
                  s.method == Method::learned ? model_hash(s.model) : "none", static_cast<int>(s.profile),
                  fmt::join(s.box_widths, ","), s.samples_factor.value_or(none), s.max_samples, s.noise, s.bins,
                  list(s.random), list(s.features), s.drop_uninformative, s.seed, s.filter_features);
  if (s.estimate_error) text += " error";
  text += fmt::format(" {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", s.alpha_factor, s.position_scale, s.redraws,
                      s.reject_second_hit, s.bias_correction, s.clamp_negative, s.clamp_infinite, s.sigma_color,
                      s.sigma_feature, s.damping, s.window, s.gamma, s.bandwidth, s.views,
                      s.crop ? text_of(*s.crop) : "whole");
  return text;
}

bool has(const Image& image, const char* name, const std::string& value) {
  const auto found = image.metadata.find(name);
  const std::string* text = found == image.metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text != nullptr && *text == value;
}

}  // namespace

std::string hash_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be opened; name a file that can be read", path));
  Hash hash;
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    hash.add(block.data(), static_cast<std::size_t>(file.gcount()));
  return hash.text();
}

std::string hash_of_ends(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be opened; name a file that can be read", path));
  const auto size = static_cast<std::uint64_t>(file.tellg());
  std::vector<char> block(std::min<std::uint64_t>(size, 1 << 20));
  Hash hash;
  for (const std::uint64_t at : {std::uint64_t{0}, size - block.size()}) {
    file.seekg(static_cast<std::streamoff>(at));
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  return fmt::format("{}-{}", size, hash.text());
}

std::string hash_of_text(const std::string& text) {
  Hash hash;
  hash.add(text.data(), text.size());
  return hash.text();
}

std::string hash_of_settings(const Settings& settings, const std::vector<std::string>& map) {
  return hash_of_text(fmt::format("{} [{}]", text_of(settings), fmt::join(map, ",")));
}

void mark(Image& image, const Origin& origin) {
  image.metadata[input_attribute] = origin.input;
  image.metadata[settings_attribute] = origin.settings;
}

bool is_made(const std::string& path, const Origin& origin, const std::function<bool(const Image&)>& is_wanted) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  try {
    const Image image = read_image(path);  // all of it: a file may have been cut
    return has(image, input_attribute, origin.input) && has(image, settings_attribute, origin.settings) &&
           is_wanted(image);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace rpf::cli
