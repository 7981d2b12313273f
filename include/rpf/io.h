// Files: samples in and out, as deep OpenEXR or raw floats (docs/file-format.md); images in and out.
// Every writer fills a temporary file beside the target, checks and syncs it, and renames it: a target is whole or
// untouched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rpf/image.h"
#include "rpf/samples.h"

namespace rpf {

/// How a file stores the values of a channel.
enum class PixelType { half_float, full_float, unsigned_int };

/// One channel of a sample file and the slot it fills.
struct SampleFileChannel {
  std::string name;  ///< as the file calls it
  std::string slot;  ///< canonical name (docs/file-format.md); empty: not used
  PixelType type = PixelType::full_float;
};

/// What the header and the sample counts of a file say, before any sample is read.
struct SampleFileInfo {
  std::string path;
  Window data_window;
  Window display_window;
  std::string compression;
  std::vector<SampleFileChannel> channels;  ///< in the file's order
  std::uint64_t sample_count = 0;
  std::uint32_t min_samples = 0, max_samples = 0;  ///< per pixel
  std::uint64_t empty_pixels = 0;                  ///< pixels without samples
  Metadata metadata;
  int value_bits = 32;                               ///< of an image: as the file stores a value
  std::vector<std::string> dropped_attributes = {};  ///< of types that Metadata does not have, as "name (type)"
};

/// What to read of a sample file, and how.
struct SampleReadOptions {
  /// slot -> channel name in the file, beats every automatic assignment; an empty channel name leaves the slot out.
  std::map<std::string, std::string> slot_map;
  /// The slots to read, of those the file has. The others are checked and inspected like these, but no sample has them.
  /// Nothing: all. needed_slots() of rpf/filter.h says what filtering takes.
  std::optional<std::vector<std::string>> slots;
  /// Bytes this read may allocate; 0: no limit. Checked before anything is allocated.
  std::uint64_t max_memory = 0;
  int threads = 0;  ///< that unpack rows of an OpenEXR file; 0: available_threads(). Never changes the result.
};

/// Whether a file begins as those with samples do. Throws Error(input) where it cannot be read.
bool is_sample_file(const std::string& path);

/// Reads header and sample counts only. The content decides what kind of file it is. Throws Error(input) with the file,
/// channel or attribute and what was expected.
SampleFileInfo inspect_samples(const std::string& path, const SampleReadOptions& options = {});

/// For so many more columns readers leave room behind SampleBuffer::values: filter() adds the position inside the pixel
/// in place.
constexpr std::size_t spare_columns = 2;

/// Reads the channels that fill a wanted slot. Throws Error(input) for a bad file, Error(memory) where the budget is
/// too small (the text has the need and the limit).
SampleBuffer read_samples(const std::string& path, const SampleReadOptions& options = {});

/// Writes a sample file; values survive exactly. By the extension: ".exr" is deep scan-line OpenEXR, ZIPS compressed,
/// marked rpf:format="mc-samples"; ".rpf" is raw floats. `half_slots`: slots that OpenEXR is to store as half. Throws
/// Error(output), and Error(usage) for a half slot that is not there.
void write_samples(const std::string& path, const SampleBuffer& samples,
                   const std::vector<std::string>& half_slots = {});

/// What the header of an image says: windows, channels and metadata. Has no pixels. Throws Error(input), also for files
/// of several images: parts, pages, frames.
Image inspect_image(const std::string& path);

/// Peak bytes of reading that image.
std::uint64_t image_bytes(const Image& header);

/// Reads any image that OpenImageIO knows as linear float. Throws Error(input) as inspect_image() does, and
/// Error(memory) where that needs more than `max_memory` bytes; 0: no limit.
Image read_image(const std::string& path, std::uint64_t max_memory = 0);

/// Writes an image; the extension chooses the format. Formats of 8 bits (png, jpg, ...) get R, G, B (A) with the sRGB
/// transfer function, clamped to [0,1]; all others get linear float and the metadata. Throws Error(output).
void write_image(const std::string& path, const Image& image);

}  // namespace rpf
