// Header and chunk table are checked first (exr_structure, header_checks); only then is memory allocated and OpenEXR's
// reader opened.
#include "io/deep_reader.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <limits>

#include "io/channel_names.h"
#include "io/exr_structure.h"
#include "io/guard.h"
#include "io/header_checks.h"
#include "io/reading.h"
#include "io/row_base.h"

namespace rpf::io {
namespace {

// A file that passed all checks, with what they found.
struct CheckedFile {
  SampleFileInfo info;
  RowTable rows;
};

std::size_t type_size(PixelType type) { return type == PixelType::half_float ? 2 : 4; }

SampleFileInfo info_of(const std::string& path, const DeepHeader& header, const SampleReadOptions& options) {
  SampleFileInfo info;
  info.path = path;
  info.compression = header.compression;
  info.metadata = header.metadata;
  info.data_window = window_of(path, "dataWindow", header.data, max_side);
  info.display_window = window_of(path, "displayWindow", header.display, std::numeric_limits<int>::max());
  std::vector<std::string> names;
  for (const HeaderChannel& channel : header.channels) names.push_back(channel.name);
  const std::vector<std::string> slots = assign_slots(path, names, options.slot_map);
  for (std::size_t i = 0; i < names.size(); ++i) info.channels.push_back({names[i], slots[i], header.channels[i].type});
  return info;
}

// Everything that can be known without decompressing.
CheckedFile check_file(const std::string& path, const SampleReadOptions& options) {
  FileBytes bytes(path);
  const std::uint64_t header_end = check_structure(bytes);
  const DeepHeader header = read_header(path, header_end);
  CheckedFile file;
  file.info = info_of(path, header, options);
  check_storage(path, header);
  check_marker(path, header, file.info.channels);
  check_slots(path, file.info.channels);
  std::size_t sample_bytes = 0;
  for (const HeaderChannel& channel : header.channels) sample_bytes += type_size(channel.type);
  file.rows = scan_rows(bytes, header_end, file.info.data_window, sample_bytes);
  file.info.sample_count = file.rows.total_samples;
  return file;
}

// OpenEXR's own tables: a count for each pixel, 40 bytes for each row, and up to three copies of one row.
std::uint64_t reader_bytes(const CheckedFile& file) {
  const Window& window = file.info.data_window;
  return window.pixel_count() * 4 + static_cast<std::uint64_t>(window.height) * 40 + file.rows.largest_row_bytes * 3;
}

// Reads the counts of one row after the other.
class CountReader {
 public:
  CountReader(Imf::DeepScanLineInputFile& file, const CheckedFile& checked)
      : file_(file), checked_(checked), counts_(static_cast<std::size_t>(checked.info.data_window.width)) {}

  /// The slice of counts: one row that every row of pixels overwrites (y stride 0).
  Imf::Slice slice() { return {Imf::UINT, row_base(counts_.data(), checked_.info.data_window.x), sizeof(unsigned), 0}; }

  /// Counts of one row, checked against the size of its samples.
  const std::vector<unsigned>& read(int row) {
    const int y = checked_.info.data_window.y + row;
    file_.readPixelSampleCounts(y);
    std::uint64_t sum = 0;
    for (const unsigned count : counts_) sum += count;
    if (sum != checked_.rows.samples[static_cast<std::size_t>(row)])
      throw Error(ErrorKind::input,
                  fmt::format("\"{}\" is damaged: row y={} counts {} samples but stores {}; copy or "
                              "render the file again",
                              checked_.info.path, y, sum, checked_.rows.samples[static_cast<std::size_t>(row)]));
    return counts_;
  }

 private:
  Imf::DeepScanLineInputFile& file_;
  const CheckedFile& checked_;
  std::vector<unsigned> counts_;
};

// Calls use(counts) for every row from top to bottom.
template <class Use>
void for_each_row(Imf::DeepScanLineInputFile& file, const CheckedFile& checked, Use use) {
  CountReader reader(file, checked);
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(reader.slice());
  file.setFrameBuffer(frame);
  for (int row = 0; row < checked.info.data_window.height; ++row) use(reader.read(row));
}

// Reads the samples of a file into a buffer whose first_sample is known.
class ValueReader {
 public:
  ValueReader(Imf::DeepScanLineInputFile& file, const CheckedFile& checked, SampleBuffer& samples)
      : file_(file), counts_(file, checked), samples_(samples) {
    const auto width = static_cast<std::size_t>(samples.data_window.width);
    pointers_.resize(samples.layout.size() * width);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice(counts_.slice());
    for (const SampleFileChannel& channel : checked.info.channels) {
      if (channel.slot.empty()) continue;
      const std::size_t column = *samples.layout.find(channel.slot);
      char* base = row_base(pointers_.data() + column * width, samples.data_window.x);
      // The record's stride spreads a channel's values over the records; half becomes float on the way.
      frame.insert(channel.name,
                   Imf::DeepSlice(Imf::FLOAT, base, sizeof(char*), 0, samples.layout.size() * sizeof(float)));
    }
    // A second frame buffer makes OpenEXR forget the counts, so each row reads them again.
    file.setFrameBuffer(frame);
  }

  void read_row(int row) {
    const auto width = static_cast<std::size_t>(samples_.data_window.width);
    const std::vector<unsigned>& counts = counts_.read(row);
    const std::uint32_t* first = samples_.first_sample.data() + static_cast<std::size_t>(row) * width;
    for (std::size_t x = 0; x < width; ++x) {
      // OpenEXR writes as many samples as the counts say now; a file that changed meanwhile must not write elsewhere.
      if (counts[x] != first[x + 1] - first[x]) throw std::runtime_error("it changed while it was read");
      for (std::size_t column = 0; column < samples_.layout.size(); ++column)
        pointers_[column * width + x] = reinterpret_cast<char*>(samples_.record(first[x]) + column);
    }
    file_.readPixels(samples_.data_window.y + row);
  }

 private:
  Imf::DeepScanLineInputFile& file_;
  CountReader counts_;
  SampleBuffer& samples_;
  std::vector<char*> pointers_;  ///< [column][x]: where the first sample of the pixel goes
};

void check_sample_budget(const CheckedFile& file, std::size_t columns, std::uint64_t limit) {
  check_sample_count(file.info);
  const std::uint64_t pixels = file.info.data_window.pixel_count();
  const std::uint64_t pointers = static_cast<std::uint64_t>(file.info.data_window.width) * columns * sizeof(char*);
  const std::uint64_t values = file.info.sample_count * columns * sizeof(float);
  check_budget(file.info.path, values + (pixels + 1) * sizeof(std::uint32_t) + pointers + reader_bytes(file), limit);
}

}  // namespace

SampleFileInfo inspect_deep(const std::string& path, const SampleReadOptions& options) {
  CheckedFile checked = check_file(path, options);
  check_budget(path, reader_bytes(checked), options.max_memory);
  return guard_input(path, [&] {
    Imf::StdIFStream stream(path.c_str());
    Imf::DeepScanLineInputFile file(stream, 0);  // 0: no threads of its own
    SampleFileInfo& info = checked.info;
    info.min_samples = std::numeric_limits<std::uint32_t>::max();
    for_each_row(file, checked, [&](const std::vector<unsigned>& counts) {
      const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
      info.min_samples = std::min(info.min_samples, *low);
      info.max_samples = std::max(info.max_samples, *high);
      info.empty_pixels += static_cast<std::uint64_t>(std::count(counts.begin(), counts.end(), 0U));
    });
    return info;
  });
}

SampleBuffer read_deep(const std::string& path, const SampleReadOptions& options) {
  CheckedFile checked = check_file(path, options);
  leave_out_unwanted(checked.info, options);
  SampleBuffer samples = empty_buffer(checked.info);
  check_sample_budget(checked, samples.layout.size(), options.max_memory);
  guard_input(path, [&] {
    Imf::StdIFStream stream(path.c_str());
    Imf::DeepScanLineInputFile file(stream, 0);
    samples.first_sample.reserve(samples.data_window.pixel_count() + 1);
    samples.first_sample.push_back(0);
    for_each_row(file, checked, [&](const std::vector<unsigned>& counts) {
      for (const unsigned count : counts) samples.first_sample.push_back(samples.first_sample.back() + count);
    });
    // All allocations are counted in check_sample_budget().
    allocate_values(samples);
    ValueReader reader(file, checked, samples);
    for (int row = 0; row < samples.data_window.height; ++row) reader.read_row(row);
  });
  return samples;
}

}  // namespace rpf::io
