// Header and chunk table are checked first (exr_structure, header_checks); only then is memory allocated. Rows are
// unpacked here and not by OpenEXR, whose reader takes more than twice as long.
#include "io/deep_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#include "io/channel_names.h"
#include "io/exr_structure.h"
#include "io/guard.h"
#include "io/header_checks.h"
#include "io/reading.h"
#include "io/spread.h"
#include "io/unpack.h"
#include "parallel/thread_count.h"
#include "parallel/workers.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

// A file that passed all checks, with what they found.
struct CheckedFile {
  SampleFileInfo info;
  RowTable rows;
  std::size_t sample_bytes = 0;  ///< over all channels
};

std::size_t type_size(PixelType type) { return type == PixelType::half_float ? 2 : 4; }

SampleFileInfo info_of(const std::string& path, const DeepHeader& header, const SampleReadOptions& options) {
  SampleFileInfo info;
  info.path = path;
  info.compression = header.compression;
  info.metadata = header.metadata;
  info.dropped_attributes = header.dropped;
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
  for (const HeaderChannel& channel : header.channels) file.sample_bytes += type_size(channel.type);
  file.rows = scan_rows(bytes, header_end, file.info.data_window, file.sample_bytes);
  file.info.sample_count = file.rows.total_samples;
  return file;
}

/// Rows for each thread at the least: one of them is in memory three times more.
constexpr int rows_of_reader = 16;

int reader_count(int rows, int threads) { return std::clamp(rows / rows_of_reader, 1, thread_count(threads)); }

// Tables of rows, and one row of each reader: packed, as differences, unpacked.
std::uint64_t reader_bytes(const CheckedFile& file, int readers) {
  const Window& window = file.info.data_window;
  const std::uint64_t row = static_cast<std::uint64_t>(window.width) * 12 + file.rows.largest_row_bytes * 3;
  return window.height * sizeof(Row) + static_cast<std::uint64_t>(readers) * row;
}

// Unpacks one row after the other.
class RowReader {
 public:
  explicit RowReader(const CheckedFile& checked)
      : checked_(checked),
        bytes_(checked.info.path),
        unpacker_(checked.info.compression),
        counts_(static_cast<std::size_t>(checked.info.data_window.width)) {}

  /// Counts of one row, checked against the size of its samples.
  const std::vector<std::uint32_t>& counts(int number) {
    const Row& row = checked_.rows.rows[static_cast<std::size_t>(number)];
    read(number, row.counts, row.counts_bytes, counts_.size() * sizeof(std::uint32_t), "counts");
    std::uint32_t before = 0;
    for (std::size_t x = 0; x < counts_.size(); ++x) {  // stored as sums from the left
      const std::uint32_t sum = word_at(unpacked_.data() + x * sizeof(std::uint32_t));
      if (sum < before) fail(number, "has counts that decrease");
      counts_[x] = sum - before;
      before = sum;
    }
    if (std::uint64_t{before} * checked_.sample_bytes != row.unpacked)
      fail(number, fmt::format("counts {} samples but stores {}", before, row.unpacked / checked_.sample_bytes));
    return counts_;
  }

  /// The samples of one row: for each channel of the file, in its order, the values of all samples.
  const std::vector<std::uint8_t>& samples(int number) {
    const Row& row = checked_.rows.rows[static_cast<std::size_t>(number)];
    read(number, row.counts + row.counts_bytes, row.packed, row.unpacked, "samples");
    return unpacked_;
  }

 private:
  void read(int number, std::uint64_t begin, std::size_t packed, std::size_t unpacked, const char* what) {
    packed_.resize(packed);
    unpacked_.resize(unpacked);
    bytes_.read(begin, packed_.data(), packed, what);
    if (!unpacker_.unpack(packed_, unpacked_)) fail(number, fmt::format("has {} that cannot be unpacked", what));
  }

  [[noreturn]] void fail(int number, const std::string& what) const {
    throw Error(ErrorKind::input, fmt::format("\"{}\" is damaged: row y={} {}; copy or render the file again",
                                              checked_.info.path, checked_.info.data_window.y + number, what));
  }

  const CheckedFile& checked_;
  FileBytes bytes_;
  Unpacker unpacker_;
  std::vector<std::uint8_t> packed_, unpacked_;
  std::vector<std::uint32_t> counts_;
};

// Several threads that unpack rows, each with what it needs for one.
class Readers {
 public:
  Readers(const CheckedFile& checked, int count) : checked_(checked), workers_(count), readers_(workers_.count()) {}

  /// Calls use(reader, row) for these rows, in any order.
  template <class Use>
  void for_all(int first, int end, const Use& use) {
    workers_.for_all(static_cast<std::size_t>(first), static_cast<std::size_t>(end),
                     [&](std::size_t row, std::size_t worker) {
                       std::unique_ptr<RowReader>& reader = readers_[worker];
                       if (!reader) reader = std::make_unique<RowReader>(checked_);
                       use(*reader, static_cast<int>(row));
                     });
  }

 private:
  const CheckedFile& checked_;
  Workers workers_;
  std::vector<std::unique_ptr<RowReader>> readers_;
};

std::vector<SpreadTarget> targets_of(const CheckedFile& checked, const SampleLayout& layout) {
  std::vector<SpreadTarget> targets;
  std::size_t begin = 0;
  for (const SampleFileChannel& channel : checked.info.channels) {
    if (!channel.slot.empty())
      targets.push_back({begin, channel.type == PixelType::half_float, *layout.find(channel.slot)});
    begin += type_size(channel.type);
  }
  return targets;
}

void check_sample_budget(const CheckedFile& file, std::size_t columns, const SampleReadOptions& options) {
  check_sample_count(file.info.path, file.info.sample_count);
  const std::uint64_t pixels = file.info.data_window.pixel_count();
  const std::uint64_t values = file.info.sample_count * columns * sizeof(float);
  const int readers = reader_count(file.info.data_window.height, options.threads);
  check_budget(file.info.path, values + (pixels + 1) * sizeof(std::uint32_t) + reader_bytes(file, readers),
               options.max_memory);
}

CheckedFile check_wanted(const std::string& path, const SampleReadOptions& options) {
  CheckedFile checked = check_file(path, options);
  leave_out_unwanted(checked.info, options);
  return checked;
}

class DeepRows : public SampleRows {
 public:
  DeepRows(const std::string& path, const SampleReadOptions& options)
      : checked_(check_wanted(path, options)),
        frame_(empty_buffer(checked_.info)),
        targets_(targets_of(checked_, frame_.layout)),
        threads_(options.threads) {}

  const CheckedFile& checked() const { return checked_; }
  const SampleBuffer& frame() const override { return frame_; }
  std::uint64_t row_samples(int row) const override {
    return checked_.rows.rows[static_cast<std::size_t>(row)].unpacked / checked_.sample_bytes;
  }
  SampleBuffer read(int first, int end) override {
    return guard_input(checked_.info.path, [&] {
      SampleBuffer samples = empty_rows(frame_, first, end);
      samples.first_sample.resize(samples.data_window.pixel_count() + 1);
      const auto first_of_row = [&](int row) {
        return samples.first_sample.begin() + std::ptrdiff_t{row - first} * samples.data_window.width;
      };
      Readers readers(checked_, reader_count(end - first, threads_));
      readers.for_all(first, end, [&](RowReader& reader, int row) {
        const std::vector<std::uint32_t>& counts = reader.counts(row);
        std::copy(counts.begin(), counts.end(), first_of_row(row) + 1);
      });
      std::partial_sum(samples.first_sample.begin(), samples.first_sample.end(), samples.first_sample.begin());
      allocate_values(samples);
      readers.for_all(first, end, [&](RowReader& reader, int row) {
        const std::vector<std::uint8_t>& unpacked = reader.samples(row);
        spread(unpacked.data(), targets_, unpacked.size() / checked_.sample_bytes, samples.record(*first_of_row(row)),
               samples.layout.size());
      });
      return samples;
    });
  }

 private:
  CheckedFile checked_;
  SampleBuffer frame_;
  std::vector<SpreadTarget> targets_;
  int threads_;
};

}  // namespace

SampleFileInfo inspect_deep(const std::string& path, const SampleReadOptions& options) {
  CheckedFile checked = check_file(path, options);
  check_budget(path, reader_bytes(checked, 1), options.max_memory);
  return guard_input(path, [&] {
    RowReader reader(checked);
    SampleFileInfo& info = checked.info;
    info.min_samples = std::numeric_limits<std::uint32_t>::max();
    for (int row = 0; row < info.data_window.height; ++row) {
      const std::vector<std::uint32_t>& counts = reader.counts(row);
      const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
      info.min_samples = std::min(info.min_samples, *low);
      info.max_samples = std::max(info.max_samples, *high);
      info.empty_pixels += static_cast<std::uint64_t>(std::count(counts.begin(), counts.end(), 0U));
    }
    return info;
  });
}

SampleBuffer read_deep(const std::string& path, const SampleReadOptions& options) {
  DeepRows rows(path, options);
  // All allocations that follow are counted here.
  check_sample_budget(rows.checked(), rows.frame().layout.size(), options);
  return rows.read(0, rows.frame().data_window.height);
}

std::unique_ptr<SampleRows> open_deep_rows(const std::string& path, const SampleReadOptions& options) {
  return std::make_unique<DeepRows>(path, options);
}

}  // namespace rpf::io
