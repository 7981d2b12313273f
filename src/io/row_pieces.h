// Writers take a frame some rows at a time, wherever its rows come from.
#pragma once

#include <cstdint>
#include <functional>

#include "rpf/rows.h"

namespace rpf::io {

/// The rows of a frame in memory.
class BufferRows : public SampleRows {
 public:
  /// The samples must outlive this.
  explicit BufferRows(const SampleBuffer& samples);

  const SampleBuffer& frame() const override { return frame_; }
  std::uint64_t row_samples(int row) const override;
  SampleBuffer read(int first, int end) override;

 private:
  const SampleBuffer& samples_;
  SampleBuffer frame_;
};

/// At most, of a piece of several rows.
constexpr std::uint64_t piece_bytes = 8 << 20;

/// Reads the rows from the top, each once, several at a time: the samples of a piece and the number of its first row.
/// Throws Error(cancelled).
void for_each_piece(SampleRows& rows, const Control& control,
                    const std::function<void(const SampleBuffer&, int)>& take);

}  // namespace rpf::io
