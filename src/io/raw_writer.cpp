#include <array>
#include <cstring>

#include "io/atomic_file.h"
#include "io/checked_writer.h"
#include "io/raw_files.h"
#include "io/raw_header.h"
#include "io/reading.h"

namespace rpf::io {
namespace {

void write_word(CheckedWriter& writer, std::uint32_t word) {
  const std::array<std::uint8_t, 4> bytes = {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                                             static_cast<std::uint8_t>(word >> 16),
                                             static_cast<std::uint8_t>(word >> 24)};
  writer.write(bytes.data(), bytes.size());
}

void write_planes(CheckedWriter& writer, const SampleBuffer& samples) {
  for (std::size_t p = 0; p < samples.data_window.pixel_count(); ++p)
    write_word(writer, samples.first_sample[p + 1] - samples.first_sample[p]);
  for (std::size_t column = 0; column < samples.layout.size(); ++column)
    for (std::size_t s = 0; s < samples.sample_count() && !writer.failed(); ++s) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, samples.record(s) + column, sizeof bits);
      write_word(writer, bits);
    }
}

}  // namespace

void write_raw(const std::string& path, const SampleBuffer& samples) {
  samples.validate();
  const std::string header = raw_header_text(path, samples);
  AtomicFile file(path);  // removed again by whatever is thrown below
  CheckedWriter writer(file.descriptor(), path);
  writer.write(header.data(), header.size());
  write_planes(writer, samples);
  writer.finish();
  check_read_back(path, inspect_raw(file.temporary_path(), {}), samples);
  file.commit();
}

}  // namespace rpf::io
