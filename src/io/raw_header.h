// The header of a raw sample file (docs/file-format.md): one line of JSON. The only place of this room that knows JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "rpf/samples.h"

namespace rpf::io {

/// A longer first line is refused: parsing takes up to fifty times its length of memory.
constexpr std::uint64_t max_raw_header_bytes = std::uint64_t{1} << 20;

struct RawHeader {
  Window data_window, display_window;
  std::vector<std::string> channels;  ///< in the order of their planes
  Metadata metadata;
  std::uint64_t end = 0;  ///< position of the first plane
};

/// Whether the file begins like a raw sample file. Inline: the library of images sees few functions of this room.
inline bool begins_like_raw(FileBytes& file) { return file.size() > 0 && file.byte(0, "its header") == '{'; }
bool is_raw(const std::string& path);

/// Throws Error(input) that names the key that is missing or not as expected.
RawHeader read_raw_header(FileBytes& file);

/// The line for a frame, whose samples it does not look at, filled up with blanks so that the planes begin at a
/// multiple of 64 bytes. Throws Error(output) for metadata that JSON cannot hold: numbers that are not finite, text
/// that is not UTF-8.
std::string raw_header_text(const std::string& path, const SampleBuffer& frame);

}  // namespace rpf::io
