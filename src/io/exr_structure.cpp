#include "io/exr_structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <limits>
#include <map>
#include <set>

#include "io/attributes.h"
#include "io/guard.h"
#include "rpf/error.h"
#include "rpf/samples.h"

namespace rpf::io {
namespace {

// The first eight bytes: a magic number, then the version in one byte and flags above it.
constexpr std::uint32_t exr_magic = 20000630;
constexpr std::uint32_t deep_flag = 0x800, multi_part_flag = 0x1000;
constexpr std::size_t max_name_length = 255;
constexpr std::uint64_t chunk_header_bytes = 28;  // y, and the sizes of count table, packed and unpacked samples
// Deflate, the strongest compression of deep files, shrinks by 1032 at most: a claim beyond it is no real file.
constexpr std::uint64_t max_expansion = 1032;

[[noreturn]] void reject(const FileBytes& file, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("\"{}\" {}", file.path(), what));
}

[[noreturn]] void reject_damaged(const FileBytes& file, const std::string& what) {
  reject(file, fmt::format("is damaged: {}; copy or render the file again", what));
}

[[noreturn]] void reject_kind(const FileBytes& file, const std::string& kind) {
  reject(file, fmt::format("is {}, but a deep scan-line OpenEXR file of one part is needed, one list entry for every "
                           "Monte Carlo sample; write it as docs/file-format.md shows, or filter an image with "
                           "--method bilateral",
                           kind));
}

void check_kind(FileBytes& file) {
  if (file.size() < 8 || file.u32(0, "the magic number") != exr_magic) reject_kind(file, "not an OpenEXR file");
  const std::uint32_t version = file.u32(4, "the version");
  if ((version & 0xff) != 2) reject_kind(file, fmt::format("OpenEXR of version {}", version & 0xff));
  if ((version & multi_part_flag) != 0) reject_kind(file, "a multi-part OpenEXR file");
  if ((version & deep_flag) == 0) reject_kind(file, "a flat OpenEXR image");
}

// Zero-terminated text; `position` moves behind it.
std::string read_name(FileBytes& file, std::uint64_t& position) {
  std::string name;
  for (;;) {
    const auto letter = static_cast<char>(file.byte(position++, "its header"));
    if (letter == '\0') return name;
    if (name.size() == max_name_length) reject_damaged(file, "a name in its header is longer than 255 bytes");
    name += letter;
  }
}

struct AttributeExtent {
  std::string name, type;
  std::uint64_t begin = 0;
  std::uint32_t size = 0;
};

// OpenEXR reads these types by their fixed size, whatever the size field says; a lie would let it run out of step.
void check_size(const FileBytes& file, const AttributeExtent& attribute) {
  static const std::map<std::string, std::uint32_t> sizes = {{"int", 4},
                                                             {"float", 4},
                                                             {"double", 8},
                                                             {"v2i", 8},
                                                             {"v2f", 8},
                                                             {"v2d", 16},
                                                             {"v3i", 12},
                                                             {"v3f", 12},
                                                             {"v3d", 24},
                                                             {"box2i", 16},
                                                             {"box2f", 16},
                                                             {"m33f", 36},
                                                             {"m33d", 72},
                                                             {"m44f", 64},
                                                             {"m44d", 128},
                                                             {"compression", 1},
                                                             {"lineOrder", 1},
                                                             {"envmap", 1},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"keycode", 28},
                                                             {"rational", 8},
                                                             {"chromaticities", 32},
                                                             {"deepImageState", 1}};
  const auto fixed = sizes.find(attribute.type);
  if (fixed != sizes.end() && fixed->second != attribute.size)
    reject_damaged(file, fmt::format("its attribute {} of type {} has {} bytes instead of {}", attribute.name,
                                     attribute.type, attribute.size, fixed->second));
  if (attribute.begin + attribute.size > std::min(file.size(), max_header_bytes))
    reject_damaged(file, fmt::format("its attribute {} claims {} bytes and reaches beyond the end of the file or the "
                                     "64 MB of the largest header",
                                     attribute.name, attribute.size));
}

// Those that a file is understood by; where another program took another type, it is named with the one expected.
void check_attribute_type(const FileBytes& file, const AttributeExtent& attribute) {
  static const std::map<std::string, std::set<std::string>> types = {{"channels", {"chlist"}},
                                                                     {"compression", {"compression"}},
                                                                     {"dataWindow", {"box2i"}},
                                                                     {"displayWindow", {"box2i"}},
                                                                     {"lineOrder", {"lineOrder"}},
                                                                     {"pixelAspectRatio", {"float"}},
                                                                     {"screenWindowCenter", {"v2f"}},
                                                                     {"screenWindowWidth", {"float"}},
                                                                     {"type", {"string"}},
                                                                     {"version", {"int"}},
                                                                     {"chunkCount", {"int"}},
                                                                     {"maxSamplesPerPixel", {"int"}},
                                                                     {"rpf:worldOrigin", {"v3f"}},
                                                                     {format_attribute, {"string"}},
                                                                     {version_attribute, {"int", "float", "double"}}};
  const auto expected = types.find(attribute.name);
  if (expected == types.end() || expected->second.count(attribute.type) > 0) return;
  reject(file, fmt::format("has the attribute {} of type {}, expected {}; write it with that type", attribute.name,
                           attribute.type, fmt::join(expected->second, " or ")));
}

// The channels are stored in the order of their names. A damaged name would move its column and shift all others.
void check_channel_list(FileBytes& file, const AttributeExtent& attribute) {
  std::uint64_t position = attribute.begin;
  std::string previous;
  for (std::size_t count = 0;; ++count) {
    const std::string name = read_name(file, position);
    if (name.empty()) break;
    if (count == max_channels)
      reject(file, fmt::format("has more than {} channels; write only what the filter uses", max_channels));
    if (name <= previous)
      reject_damaged(file,
                     fmt::format("channel {} stands after {} in its header, but channels are sorted", name, previous));
    previous = name;
    position += 16;  // not read here: type, linearity and sampling
  }
  if (position != attribute.begin + attribute.size)
    reject_damaged(file, "its channel list does not fill its attribute");
}

void check_type(FileBytes& file, const AttributeExtent& attribute) {
  std::string type(attribute.size, '\0');
  file.read(attribute.begin, type.data(), type.size(), "its header");
  if (type == "deeptile") reject_kind(file, "a tiled deep OpenEXR file");
  if (type != "deepscanline") reject_damaged(file, R"(its attribute type is not "deepscanline")");
}

// Returns false at the end of the header.
bool next_attribute(FileBytes& file, std::uint64_t& position, AttributeExtent& attribute) {
  attribute.name = read_name(file, position);
  if (attribute.name.empty()) return false;
  attribute.type = read_name(file, position);
  attribute.size = file.u32(position, "its header");
  attribute.begin = position + 4;
  position = attribute.begin + attribute.size;
  check_attribute_type(file, attribute);
  check_size(file, attribute);
  return true;
}

void check_chunk(FileBytes& file, std::uint64_t offset, int y, const Window& window, std::size_t sample_bytes,
                 RowTable& rows) {
  const char* what = "the header of a row";
  if (offset == 0) reject(file, fmt::format("is incomplete: row y={} was never written; render the file again", y));
  // Two rows that share a chunk would count it twice.
  const auto stored_y = static_cast<std::int32_t>(file.u32(offset, what));
  if (stored_y != y) reject_damaged(file, fmt::format("the chunk of row y={} says y={}", y, stored_y));
  const std::uint64_t table = file.u64(offset + 4, what), packed = file.u64(offset + 12, what);
  const std::uint64_t unpacked = file.u64(offset + 20, what);
  // Subtracting from the size cannot overflow, as adding to a damaged offset could.
  const std::uint64_t behind_header = file.size() - std::min(file.size(), offset + chunk_header_bytes);
  if (table > behind_header || packed > behind_header - table)
    reject(file, fmt::format("is truncated: row y={} reaches beyond its end; copy or render the file again", y));
  if (static_cast<std::uint64_t>(window.width) * 4 > table * max_expansion || unpacked / max_expansion > packed ||
      (unpacked > 0 && packed == 0))
    reject_damaged(file, fmt::format("row y={} claims more data than its {} bytes can hold", y, table + packed));
  if (unpacked % sample_bytes != 0 || unpacked > std::numeric_limits<std::int32_t>::max())
    reject_damaged(file, fmt::format("row y={} claims {} bytes of samples, expected a multiple of the {} bytes of a "
                                     "sample below 2 GB",
                                     y, unpacked, sample_bytes));
  if (table > static_cast<std::uint64_t>(window.width) * 4 || packed > unpacked)
    reject_damaged(file, fmt::format("row y={} is larger packed than unpacked", y));
  rows.rows.push_back({offset + chunk_header_bytes, static_cast<std::uint32_t>(table),
                       static_cast<std::uint32_t>(packed), static_cast<std::uint32_t>(unpacked)});
  rows.total_samples += unpacked / sample_bytes;
  rows.largest_row_bytes = std::max(rows.largest_row_bytes, unpacked);
}

}  // namespace

bool is_deep_exr(FileBytes& file) {
  return file.size() >= 8 && file.u32(0, "the magic number") == exr_magic &&
         (file.u32(4, "the version") & deep_flag) != 0;
}

std::uint64_t check_structure(FileBytes& file) {
  check_kind(file);
  // OpenEXR silently takes defaults for missing ones, so a damaged name would change the picture's place or size.
  std::set<std::string> missing = {"channels",  "compression",      "dataWindow",         "displayWindow",
                                   "lineOrder", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth",
                                   "type",      "version"};
  std::uint64_t position = 8;
  AttributeExtent attribute;
  for (std::size_t count = 0; next_attribute(file, position, attribute); ++count) {
    if (count == max_attributes) reject(file, fmt::format("has more than {} header attributes", max_attributes));
    missing.erase(attribute.name);
    // OpenEXR reads a list of this type to its end whatever its size, under any name.
    if (attribute.name == "channels" || attribute.type == "chlist") check_channel_list(file, attribute);
    if (attribute.name == "type") check_type(file, attribute);
  }
  if (!missing.empty()) reject_damaged(file, fmt::format("its header has no attribute {}", *missing.begin()));
  return position;
}

RowTable scan_rows(FileBytes& file, std::uint64_t chunk_table, const Window& data_window, std::size_t sample_bytes) {
  const auto height = static_cast<std::uint64_t>(data_window.height);
  const std::uint64_t left = file.size() - std::min(file.size(), chunk_table);
  if (height > left / (8 + chunk_header_bytes))
    reject(file, fmt::format("is truncated or damaged: {} rows of pixels need at least {} bytes behind the header, but "
                             "only {} follow; copy or render the file again",
                             height, height * (8 + chunk_header_bytes), left));
  RowTable rows;
  rows.rows.reserve(height);
  std::array<std::uint64_t, 512> offsets{};  // read in blocks: the table and the chunks are far apart
  for (std::uint64_t row = 0; row < height; ++row) {
    if (row % offsets.size() == 0)
      for (std::uint64_t i = row; i < std::min(height, row + offsets.size()); ++i)
        offsets[i - row] = file.u64(chunk_table + i * 8, "the table of rows");
    const int y = data_window.y + static_cast<int>(row);
    check_chunk(file, offsets[row % offsets.size()], y, data_window, sample_bytes, rows);
  }
  return rows;
}

}  // namespace rpf::io
