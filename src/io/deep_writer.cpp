// Through a stream that loses no error.
#include "io/deep_writer.h"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include "io/atomic_file.h"
#include "io/attributes.h"
#include "io/checked_writer.h"
#include "io/deep_reader.h"
#include "io/exr_output.h"
#include "io/guard.h"
#include "io/near_names.h"
#include "io/reading.h"
#include "io/row_base.h"
#include "io/row_pieces.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

// ZIPS: one row a chunk, so rows can be read alone.
Imf::Header header_of(const SampleBuffer& frame, const std::vector<Imf::PixelType>& types) {
  Imf::Header header(box_of(frame.display_window), box_of(frame.data_window));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  for (std::size_t c = 0; c < types.size(); ++c)
    header.channels().insert(frame.layout.slots[c], Imf::Channel(types[c]));
  for (const auto& [name, value] : frame.metadata)
    if (!is_structural(name)) insert_attribute(header, name, value);
  header.insert(format_attribute, Imf::StringAttribute(format_value));
  header.insert(version_attribute, Imf::IntAttribute(format_version));
  return header;
}

std::vector<Imf::PixelType> types_of(const SampleLayout& layout, const std::vector<std::string>& half_slots) {
  std::vector<Imf::PixelType> types(layout.size(), Imf::FLOAT);
  for (const std::string& slot : half_slots) {
    const auto column = layout.find(slot);
    if (!column)
      throw Error(ErrorKind::usage, fmt::format("slot \"{}\" cannot be stored as half because the samples do not have "
                                                "it; near names are {}",
                                                slot, near_names(slot, layout.slots)));
    types[*column] = Imf::HALF;
  }
  return types;
}

// One row of samples as OpenEXR wants it: counts, and for each channel and pixel a pointer to the first value.
class RowSource {
 public:
  RowSource(const SampleBuffer& frame, const std::vector<Imf::PixelType>& types)
      : frame_(frame), types_(types), width_(static_cast<std::size_t>(frame.data_window.width)) {
    counts_.resize(width_);
    pointers_.resize(width_ * types.size());
    halves_.resize(types.size());
  }

  Imf::DeepFrameBuffer slices() {
    const int min_x = frame_.data_window.x;
    Imf::DeepFrameBuffer frame;
    // Every row of pixels uses the same row of counts and pointers (y stride 0).
    frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, row_base(counts_.data(), min_x), sizeof(unsigned), 0));
    for (std::size_t c = 0; c < types_.size(); ++c) {
      const std::size_t stride = types_[c] == Imf::HALF ? sizeof(half) : frame_.layout.size() * sizeof(float);
      frame.insert(frame_.layout.slots[c], Imf::DeepSlice(types_[c], row_base(pointers_.data() + c * width_, min_x),
                                                          sizeof(const char*), 0, stride));
    }
    return frame;
  }

  /// The row of these samples; they stay until it is written.
  void fill(const SampleBuffer& samples, std::size_t row) {
    const std::uint32_t* first = samples.first_sample.data() + row * width_;
    for (std::size_t x = 0; x < width_; ++x) counts_[x] = first[x + 1] - first[x];
    for (std::size_t c = 0; c < types_.size(); ++c) {
      if (types_[c] == Imf::HALF) convert(samples, c, first[0], first[width_]);
      for (std::size_t x = 0; x < width_; ++x)
        pointers_[c * width_ + x] = types_[c] == Imf::HALF
                                        ? reinterpret_cast<const char*>(halves_[c].data() + (first[x] - first[0]))
                                        : reinterpret_cast<const char*>(samples.record(first[x]) + c);
    }
  }

 private:
  void convert(const SampleBuffer& samples, std::size_t column, std::size_t begin, std::size_t end) {
    halves_[column].resize(end - begin);
    for (std::size_t s = begin; s < end; ++s) halves_[column][s - begin] = half(samples.record(s)[column]);
  }

  const SampleBuffer& frame_;  ///< without its samples
  const std::vector<Imf::PixelType>& types_;
  std::size_t width_;
  std::vector<unsigned> counts_;
  std::vector<const char*> pointers_;      ///< [column][x]
  std::vector<std::vector<half>> halves_;  ///< [column][sample of the row]
};

// The output file writes its table of rows when it is destroyed, so it must be gone before writer.finish().
void write_rows(CheckedWriter& writer, const std::string& path, SampleRows& rows,
                const std::vector<Imf::PixelType>& types, const Control& control) {
  WriterStream stream(writer, path);
  Imf::DeepScanLineOutputFile file(stream, header_of(rows.frame(), types), 0);
  RowSource source(rows.frame(), types);
  file.setFrameBuffer(source.slices());
  for_each_piece(rows, control, [&](const SampleBuffer& samples, int) {
    for (int row = 0; row < samples.data_window.height; ++row) {
      source.fill(samples, static_cast<std::size_t>(row));
      file.writePixels(1);
    }
  });
}

}  // namespace

void write_deep(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots,
                const Control& control) {
  const auto types = types_of(rows.frame().layout, half_slots);
  AtomicFile file(path);  // removed again by whatever is thrown below
  CheckedWriter writer(file.descriptor(), path);
  try {
    write_rows(writer, path, rows, types, control);
  } catch (const Error&) {  // of reading, or cancelled
    throw;
  } catch (const std::exception& error) {
    writer.finish();  // throws the reason if it was a failed write
    throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written ({}); correct the samples or their metadata",
                                               path, first_line(error.what())));
  }
  writer.finish();
  check_read_back(path, inspect_deep(file.temporary_path(), {}), rows.frame().data_window, rows.sample_count());
  file.commit();
}

}  // namespace rpf::io
