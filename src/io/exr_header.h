// The header of a sample file as plain data, without OpenEXR's types.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rpf/image.h"
#include "rpf/io.h"

namespace rpf::io {

struct HeaderChannel {
  std::string name;
  PixelType type = PixelType::full_float;
  int x_sampling = 1, y_sampling = 1;
};

/// Corners as the file has them, both included. Still unchecked, hence 64 bits.
struct Corners {
  std::int64_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

struct DeepHeader {
  Corners data, display;
  std::string compression;  ///< OpenEXR's name in lower case: "none", "rle", "zips", ...
  std::optional<int> chunk_count;
  std::vector<HeaderChannel> channels;
  std::optional<std::string> format;  ///< rpf:format
  std::optional<double> version;      ///< rpf:version
  Metadata metadata;
  std::vector<std::string> dropped;  ///< attributes of types that Metadata does not have, as "name (type)"
};

/// Parses the header with OpenEXR; check_structure() must have accepted the file, `header_end` is its result.
/// Throws Error(input) with OpenEXR's words.
DeepHeader read_header(const std::string& path, std::uint64_t header_end);

}  // namespace rpf::io
