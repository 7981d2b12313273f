// The skeleton of a deep OpenEXR file, walked with bounds before OpenEXR sees it: OpenEXR's reader allocates what the
// header and the chunks claim, so a few kilobytes could ask for gigabytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "rpf/image.h"

namespace rpf::io {

/// Limits of what is read; docs/file-format.md lists them.
constexpr std::size_t max_channels = 1024;
constexpr std::size_t max_attributes = 4096;
constexpr std::uint64_t max_header_bytes = std::uint64_t{64} << 20;

/// Whether the file begins like a deep OpenEXR file, of whatever kind.
bool is_deep_exr(FileBytes& file);

/// Checks that the file is one deep scan-line part whose header is whole, holds every required attribute and nothing
/// beyond the limits. Returns the position behind the header, where the table of chunk offsets begins.
/// Throws Error(input) that says what the file is instead.
std::uint64_t check_structure(FileBytes& file);

/// What a chunk's header says: a deep scan-line chunk is one row of pixels.
struct Row {
  std::uint64_t counts = 0;                ///< position of the packed counts; the packed samples follow
  std::uint32_t counts_bytes = 0;          ///< packed
  std::uint32_t packed = 0, unpacked = 0;  ///< bytes of the samples
};

struct RowTable {
  std::vector<Row> rows;  ///< [height]
  std::uint64_t total_samples = 0;
  std::uint64_t largest_row_bytes = 0;  ///< unpacked bytes of samples in the largest row
};

/// Reads the offset and the header of every chunk and checks them against the file's size, the width of the rows and
/// what compression can do. `sample_bytes` is the size of one sample over all channels of the file.
RowTable scan_rows(FileBytes& file, std::uint64_t chunk_table, const Window& data_window, std::size_t sample_bytes);

}  // namespace rpf::io
