#include "io/raw_header.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "io/attributes.h"
#include "io/exr_structure.h"
#include "io/guard.h"
#include "io/header_checks.h"
#include "io/near_names.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* raw_format = "rpf-raw-samples";
constexpr int raw_version = 1;
constexpr std::int64_t farthest = (std::int64_t{1} << 30) - 2;  // of a pixel's coordinates: OpenEXR's limit
constexpr std::size_t alignment = 64;  // of the first plane: a cache line, for those who map the file

[[noreturn]] void reject(const FileBytes& file, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("\"{}\" {}", file.path(), what));
}

[[noreturn]] void reject_key(const FileBytes& file, const std::string& key, const std::string& expected) {
  reject(file,
         fmt::format("has an unexpected value of \"{}\" in its header, expected {}; write it as docs/file-format.md "
                     "shows",
                     key, expected));
}

// ---- reading

/// The first line without its end; `end` becomes the position behind it.
std::string first_line_of(FileBytes& file, std::uint64_t& end) {
  const std::uint64_t limit = std::min(file.size(), max_raw_header_bytes);
  std::string line;
  for (std::uint64_t position = 0; position < limit; ++position) {
    const auto letter = static_cast<char>(file.byte(position, "its header"));
    end = position + 1;
    if (letter == '\n') return line;
    line += letter;
  }
  reject(file,
         fmt::format("has no end of line in its first {} bytes; a raw sample file begins with one line of JSON, as "
                     "docs/file-format.md shows",
                     limit));
}

/// The parser's own words name the byte, but also its classes: what stands behind the last colon says it.
Json parse(const FileBytes& file, const std::string& line) {
  try {
    return Json::parse(line);
  } catch (const Json::exception& error) {
    const std::string text = error.what();
    reject(file, fmt::format("has a first line that is no JSON ({}); write it as docs/file-format.md shows",
                             text.substr(text.rfind("] ") == std::string::npos ? 0 : text.rfind("] ") + 2)));
  }
}

const Json& member(const FileBytes& file, const Json& header, const char* key) {
  const auto found = header.find(key);
  if (found == header.end())
    reject(file, fmt::format("has no key \"{}\" in its header; write it as docs/file-format.md shows", key));
  return *found;
}

/// Negative and beyond 32 bits too: nothing where the value is no such integer.
std::optional<std::int32_t> integer_of(const Json& value) {
  if (!value.is_number_integer()) return std::nullopt;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int32_t>::max())
    return std::nullopt;
  const auto number = value.get<std::int64_t>();
  if (number < std::numeric_limits<std::int32_t>::min()) return std::nullopt;
  return static_cast<std::int32_t>(number);
}

std::optional<float> float_of(const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const auto number = value.get<double>();
  if (std::abs(number) > static_cast<double>(std::numeric_limits<float>::max())) return std::nullopt;
  return static_cast<float>(number);
}

Window window_of_key(const FileBytes& file, const char* key, const Json& value, std::int64_t limit) {
  std::vector<std::int64_t> numbers;
  for (const Json& number : value)
    if (const auto integer = integer_of(number)) numbers.push_back(*integer);
  if (!value.is_array() || value.size() != 4 || numbers.size() != 4)
    reject_key(file, key, "[x, y, width, height], four integers of 32 bits");
  const Corners corners{numbers[0], numbers[1], numbers[0] + numbers[2] - 1, numbers[1] + numbers[3] - 1};
  if (std::min(corners.min_x, corners.min_y) < -farthest || std::max(corners.max_x, corners.max_y) > farthest)
    reject_key(file, key, fmt::format("a window within {} pixels around the origin", farthest));
  return window_of(file.path(), key, corners, limit);
}

/// What OpenEXR takes for a name, so that every raw file can be converted.
bool is_name(const std::string& text) { return !text.empty() && text.size() <= 255 && printable(text) == text; }

std::vector<std::string> channels_of(const FileBytes& file, const Json& value) {
  if (!value.is_array()) reject_key(file, "channels", "a list of names");
  if (value.size() > max_channels) reject_key(file, "channels", fmt::format("at most {} names", max_channels));
  std::vector<std::string> names;
  std::set<std::string> distinct;
  for (const Json& name : value) {
    if (!name.is_string() || !is_name(name.get<std::string>()))
      reject_key(file, "channels", "a list of names of 1 to 255 bytes without control characters");
    names.push_back(name.get<std::string>());
    if (!distinct.insert(names.back()).second)
      reject_key(file, "channels", fmt::format("distinct names, but {} is there twice", names.back()));
  }
  return names;
}

std::optional<Attribute> attribute_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (const auto integer = integer_of(value)) return *integer;
  if (value.is_number_integer()) return std::nullopt;  // beyond 32 bits: as a float it would be another number
  if (const auto real = float_of(value)) return *real;
  if (!value.is_array()) return std::nullopt;
  std::vector<float> floats;
  for (const Json& element : value) {
    const auto real = float_of(element);
    if (!real) return std::nullopt;
    floats.push_back(*real);
  }
  return floats;
}

Metadata metadata_of(const FileBytes& file, const Json& value) {
  Metadata metadata;
  if (!value.is_object()) reject_key(file, "metadata", "an object of names and values");
  if (value.size() > max_attributes) reject_key(file, "metadata", fmt::format("at most {} values", max_attributes));
  for (const auto& [name, element] : value.items()) {
    const auto attribute = attribute_of(element);
    if (!attribute) reject_key(file, "metadata." + name, "a text, an integer of 32 bits, a float or a list of floats");
    if (!is_name(name)) reject_key(file, "metadata", "names of 1 to 255 bytes without control characters");
    if (!is_structural(name)) metadata[name] = *attribute;
  }
  return metadata;
}

void check_keys(const FileBytes& file, const Json& header) {
  static const std::vector<std::string> keys = {"format",   "version",    "channels",
                                                "metadata", "dataWindow", "displayWindow"};
  for (const auto& [key, value] : header.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      reject(file, fmt::format("has the unknown key \"{}\" in its header; near: {}", key, near_names(key, keys)));
}

// ---- writing

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written: {}", path, what));
}

Json json_of(const Window& w) { return Json::array({w.x, w.y, w.width, w.height}); }

Json json_of(const std::string& path, const std::string& name, const Attribute& attribute) {
  if (const auto* number = std::get_if<std::int32_t>(&attribute)) return *number;
  if (const auto* text = std::get_if<std::string>(&attribute)) return *text;
  const auto* real = std::get_if<float>(&attribute);
  const std::vector<float> floats =
      real != nullptr ? std::vector<float>{*real} : std::get<std::vector<float>>(attribute);
  for (const float value : floats)
    if (!std::isfinite(value))
      refuse(path, fmt::format("the attribute {} is not finite, and JSON has no such number; remove it from the input",
                               name));
  return real != nullptr ? Json(*real) : Json(floats);
}

}  // namespace

bool is_raw(const std::string& path) {
  FileBytes file(path);
  return begins_like_raw(file);
}

RawHeader read_raw_header(FileBytes& file) {
  RawHeader header;
  const Json json = parse(file, first_line_of(file, header.end));
  if (!json.is_object()) reject(file, "has a first line that is no JSON object; write it as docs/file-format.md shows");
  if (member(file, json, "format") != raw_format) reject_key(file, "format", fmt::format("\"{}\"", raw_format));
  if (member(file, json, "version") != raw_version)
    reject_key(file, "version", fmt::format("{}, the version that this program reads", raw_version));
  check_keys(file, json);
  header.data_window = window_of_key(file, "dataWindow", member(file, json, "dataWindow"), max_side);
  header.display_window = header.data_window;
  if (json.contains("displayWindow"))
    header.display_window =
        window_of_key(file, "displayWindow", json["displayWindow"], std::numeric_limits<int>::max());
  header.channels = channels_of(file, member(file, json, "channels"));
  if (json.contains("metadata")) header.metadata = metadata_of(file, json["metadata"]);
  return header;
}

std::string raw_header_text(const std::string& path, const SampleBuffer& frame) {
  Json json{{"format", raw_format},
            {"version", raw_version},
            {"dataWindow", json_of(frame.data_window)},
            {"displayWindow", json_of(frame.display_window)},
            {"channels", frame.layout.slots},
            {"metadata", Json::object()}};
  for (const auto& [name, attribute] : frame.metadata)
    if (!is_structural(name)) json["metadata"][name] = json_of(path, name, attribute);
  std::string text;
  try {
    text = json.dump();
  } catch (const Json::exception&) {
    refuse(path, "a channel or attribute is not UTF-8, which JSON needs; rename it in the input");
  }
  text.append(alignment - 1 - text.size() % alignment, ' ');
  text += '\n';
  if (text.size() > max_raw_header_bytes)
    refuse(path, fmt::format("its header takes {} bytes, more than the {} that are read; remove attributes",
                             text.size(), max_raw_header_bytes));
  return text;
}

}  // namespace rpf::io
