// Which kind of sample file it is: by content when reading, by extension when writing.
#include <algorithm>

#include "io/deep_reader.h"
#include "io/deep_writer.h"
#include "io/exr_structure.h"
#include "io/raw_files.h"
#include "io/raw_header.h"
#include "io/reading.h"
#include "io/row_pieces.h"
#include "io/sample_formats.h"

namespace rpf {
bool is_sample_file(const std::string& path) {
  io::FileBytes file(path);
  return io::is_raw(path) || io::is_deep_exr(file);
}

SampleFileInfo inspect_samples(const std::string& path, const SampleReadOptions& options) {
  return io::is_raw(path) ? io::inspect_raw(path, options) : io::inspect_deep(path, options);
}

SampleBuffer read_samples(const std::string& path, const SampleReadOptions& options) {
  return io::is_raw(path) ? io::read_raw(path, options) : io::read_deep(path, options);
}

std::unique_ptr<SampleRows> open_sample_rows(const std::string& path, const SampleReadOptions& options) {
  auto rows = io::is_raw(path) ? io::open_raw_rows(path, options) : io::open_deep_rows(path, options);
  io::check_sample_count(path, rows->sample_count());
  return rows;
}

void write_samples(const std::string& path, const SampleBuffer& samples, const std::vector<std::string>& half_slots) {
  samples.validate();
  io::BufferRows rows(samples);
  write_sample_rows(path, rows, half_slots);
}

void write_sample_rows(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots,
                       const Control& control) {
  if (io::sample_format_of(path) == io::SampleFormat::raw)
    io::write_raw(path, rows, control);
  else
    io::write_deep(path, rows, half_slots, control);
}

std::uint64_t write_rows_memory(const SampleRows& rows) {
  constexpr std::uint64_t row_copies = 3;  // as floats, as differences, packed
  std::uint64_t row = 0;
  for (int y = 0; y < rows.frame().data_window.height; ++y) row = std::max(row, rows.row_bytes(y));
  return std::max(row, io::piece_bytes) + row_copies * row;
}

}  // namespace rpf
