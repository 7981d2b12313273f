#include <array>
#include <cstring>
#include <vector>

#include "io/atomic_file.h"
#include "io/checked_writer.h"
#include "io/raw_files.h"
#include "io/raw_header.h"
#include "io/reading.h"
#include "io/row_pieces.h"

namespace rpf::io {
namespace {

constexpr std::uint64_t word = 4;  ///< bytes

/// Little-endian words, whatever the machine has.
class Words {
 public:
  void add(std::uint32_t bits) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  /// Writes and forgets them.
  void write(CheckedWriter& writer, std::uint64_t position) {
    writer.seek(position);
    writer.write(bytes_.data(), bytes_.size());
    bytes_.clear();
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// Each plane has its place: rows go to all of them as they come.
void write_planes(CheckedWriter& writer, std::uint64_t begin, SampleRows& rows, const Control& control) {
  const std::uint64_t pixels = rows.frame().data_window.pixel_count(), total = rows.sample_count();
  const auto width = static_cast<std::uint64_t>(rows.frame().data_window.width);
  std::uint64_t before = 0;  // samples
  Words words;
  for_each_piece(rows, control, [&](const SampleBuffer& samples, int first) {
    for (std::size_t p = 0; p < samples.data_window.pixel_count(); ++p)
      words.add(samples.first_sample[p + 1] - samples.first_sample[p]);
    words.write(writer, begin + static_cast<std::uint64_t>(first) * width * word);
    for (std::size_t column = 0; column < samples.layout.size() && !writer.failed(); ++column) {
      for (std::size_t s = 0; s < samples.sample_count(); ++s) words.add(bits_of(samples.record(s)[column]));
      words.write(writer, begin + (pixels + column * total + before) * word);
    }
    before += samples.sample_count();
  });
}

}  // namespace

void write_raw(const std::string& path, SampleRows& rows, const Control& control) {
  const std::string header = raw_header_text(path, rows.frame());
  AtomicFile file(path);  // removed again by whatever is thrown below
  CheckedWriter writer(file.descriptor(), path);
  writer.write(header.data(), header.size());
  write_planes(writer, header.size(), rows, control);
  writer.finish();
  check_read_back(path, inspect_raw(file.temporary_path(), {}), rows.frame().data_window, rows.sample_count());
  file.commit();
}

}  // namespace rpf::io
