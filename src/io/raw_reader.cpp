#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "io/channel_names.h"
#include "io/guard.h"
#include "io/header_checks.h"
#include "io/raw_files.h"
#include "io/raw_header.h"
#include "io/reading.h"
#include "io/spread.h"

namespace rpf::io {
namespace {

constexpr std::size_t word = 4;            // bytes of a count or a value
constexpr std::size_t block_words = 4096;  // that are read at once
/// Samples that become records at once: all their values stay in the second cache or near it, and the pieces of a plane
/// are long enough for a disk.
constexpr std::size_t piece_samples = 16384;

// A file whose header and size fit together.
struct CheckedFile {
  SampleFileInfo info;
  std::uint64_t planes = 0;  ///< position of the counts; the planes of values follow
};

/// Calls use(word, index) for `count` little-endian words from `begin` on.
template <class Use>
void for_each_word(FileBytes& file, std::uint64_t begin, std::uint64_t count, const char* what, Use use) {
  std::array<std::uint8_t, block_words * word> block{};
  for (std::uint64_t done = 0; done < count; done += block_words) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(block_words, count - done));
    file.read(begin + done * word, block.data(), part * word, what);
    for (std::size_t i = 0; i < part; ++i) use(word_at(block.data() + i * word), done + i);
  }
}

SampleFileInfo info_of(const FileBytes& file, const RawHeader& header, const SampleReadOptions& options) {
  SampleFileInfo info;
  info.path = file.path();
  info.data_window = header.data_window;
  info.display_window = header.display_window;
  info.compression = "none";
  info.metadata = header.metadata;
  const std::vector<std::string> slots = assign_slots(file.path(), header.channels, options.slot_map);
  for (std::size_t c = 0; c < slots.size(); ++c)
    info.channels.push_back({header.channels[c], slots[c], PixelType::full_float});
  return info;
}

/// What the file's size leaves for values says how many samples there are; the counts must agree with it.
CheckedFile check_file(FileBytes& file, const SampleReadOptions& options) {
  const RawHeader header = read_raw_header(file);
  CheckedFile checked{info_of(file, header, options), header.end};
  check_slots(file.path(), checked.info.channels);
  const std::uint64_t counts = checked.info.data_window.pixel_count() * word;
  const std::uint64_t behind = file.size() - header.end, sample_bytes = header.channels.size() * word;
  if (behind < counts || (behind - counts) % sample_bytes != 0)
    throw Error(
        ErrorKind::input,
        fmt::format("\"{}\" is truncated or damaged: {} bytes follow its header, expected {} for the counts of its "
                    "dataWindow and a multiple of {} for its channels; copy or write the file again",
                    file.path(), behind, counts, sample_bytes));
  checked.info.sample_count = (behind - counts) / sample_bytes;
  return checked;
}

/// Calls use(count, pixel) for every pixel. The sum is checked on the way, so that no number of ours can overflow.
template <class Use>
void for_each_count(FileBytes& file, const CheckedFile& checked, Use use) {
  const std::uint64_t expected = checked.info.sample_count;
  std::uint64_t sum = 0;
  const auto fail = [&] {
    throw Error(ErrorKind::input,
                fmt::format("\"{}\" is truncated or damaged: its counts ask for {} samples {}, but it "
                            "holds {}; copy or write the file again",
                            file.path(), sum, sum > expected ? "or more" : "", expected));
  };
  for_each_word(file, checked.planes, checked.info.data_window.pixel_count(), "the counts",
                [&](std::uint32_t count, std::uint64_t pixel) {
                  sum += count;
                  if (sum > expected) fail();
                  use(count, pixel);
                });
  if (sum != expected) fail();
}

void check_sample_budget(const CheckedFile& checked, std::size_t columns, std::uint64_t limit) {
  check_sample_count(checked.info.path, checked.info.sample_count);
  const std::uint64_t pixels = checked.info.data_window.pixel_count();
  check_budget(checked.info.path, (checked.info.sample_count * columns + pixels + 1) * word, limit);
}

class RawRows : public SampleRows {
 public:
  RawRows(const std::string& path, const SampleReadOptions& options)
      : file_(path), checked_(check_file(file_, options)) {
    leave_out_unwanted(checked_.info, options);
    frame_ = empty_buffer(checked_.info);
    find_planes();
    const auto width = static_cast<std::uint64_t>(frame_.data_window.width);
    first_of_row_.assign(static_cast<std::size_t>(frame_.data_window.height) + 1, 0);
    for_each_count(file_, checked_,
                   [&](std::uint32_t count, std::uint64_t pixel) { first_of_row_[pixel / width + 1] += count; });
    std::partial_sum(first_of_row_.begin(), first_of_row_.end(), first_of_row_.begin());
  }

  const CheckedFile& checked() const { return checked_; }
  const SampleBuffer& frame() const override { return frame_; }
  std::uint64_t row_samples(int row) const override {
    return first_of_row_[static_cast<std::size_t>(row) + 1] - first_of_row_[static_cast<std::size_t>(row)];
  }
  SampleBuffer read(int first, int end) override {
    return guard_input(checked_.info.path, [&] {
      SampleBuffer samples = empty_rows(frame_, first, end);
      const std::uint64_t before =
          static_cast<std::uint64_t>(first) * static_cast<std::uint64_t>(frame_.data_window.width);
      for_each_word(file_, checked_.planes + before * word, samples.data_window.pixel_count(), "the counts",
                    [&](std::uint32_t count, std::uint64_t) {
                      samples.first_sample.push_back(samples.first_sample.back() + count);
                    });
      allocate_values(samples);
      fill(samples, first_of_row_[static_cast<std::size_t>(first)]);
      return samples;
    });
  }

 private:
  /// Piece by piece of all planes: plane by plane, every record would come from memory once a channel. `before`:
  /// samples of the frame.
  void fill(SampleBuffer& samples, std::uint64_t before) {
    const std::size_t count = samples.sample_count();
    std::vector<std::uint8_t> bytes(planes_.size() * std::min(piece_samples, count) * word);
    for (std::size_t first = 0; first < count; first += piece_samples) {
      const std::size_t number = std::min(piece_samples, count - first);
      std::uint8_t* to = bytes.data();
      for (const std::uint64_t plane : planes_) {
        file_.read(plane + (before + first) * word, to, number * word, "the values");
        to += number * word;
      }
      spread(bytes.data(), targets_, number, samples.record(first), samples.layout.size());
    }
  }

  /// Where the planes begin that are read, and where their values go.
  void find_planes() {
    std::uint64_t plane = checked_.planes + frame_.data_window.pixel_count() * word;
    for (const SampleFileChannel& channel : checked_.info.channels) {
      if (!channel.slot.empty()) {
        targets_.push_back({planes_.size() * word, false, *frame_.layout.find(channel.slot)});
        planes_.push_back(plane);
      }
      plane += checked_.info.sample_count * word;
    }
  }

  FileBytes file_;
  CheckedFile checked_;
  SampleBuffer frame_;
  std::vector<std::uint64_t> planes_;
  std::vector<SpreadTarget> targets_;
  std::vector<std::uint64_t> first_of_row_;  ///< [row + 1]: samples before it
};

}  // namespace

SampleFileInfo inspect_raw(const std::string& path, const SampleReadOptions& options) {
  return guard_input(path, [&] {
    FileBytes file(path);
    CheckedFile checked = check_file(file, options);
    SampleFileInfo& info = checked.info;
    info.min_samples = std::numeric_limits<std::uint32_t>::max();
    for_each_count(file, checked, [&](std::uint32_t count, std::uint64_t) {
      info.min_samples = std::min(info.min_samples, count);
      info.max_samples = std::max(info.max_samples, count);
      info.empty_pixels += count == 0 ? 1 : 0;
    });
    return info;
  });
}

SampleBuffer read_raw(const std::string& path, const SampleReadOptions& options) {
  return guard_input(path, [&] {
    RawRows rows(path, options);
    check_sample_budget(rows.checked(), rows.frame().layout.size(), options.max_memory);
    return rows.read(0, rows.frame().data_window.height);
  });
}

std::unique_ptr<SampleRows> open_raw_rows(const std::string& path, const SampleReadOptions& options) {
  return guard_input(path, [&] { return std::make_unique<RawRows>(path, options); });
}

}  // namespace rpf::io
