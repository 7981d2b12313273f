#include "io/row_pieces.h"

#include <chrono>

#include "io/reading.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

class Watch {
 public:
  Watch(const Control& control, std::uint64_t samples) : control_(control), samples_(samples) {}

  void done(std::uint64_t samples) {
    if (!control_.progress) return;
    done_ += samples;
    Progress progress;
    progress.passes = 1;
    progress.fraction = samples_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(samples_);
    progress.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    progress.seconds_left = progress.fraction > 0 ? progress.seconds * (1 / progress.fraction - 1) : -1;
    if (!control_.progress(progress)) throw Error(ErrorKind::cancelled, "cancelled; nothing was written");
  }

 private:
  const Control& control_;
  std::uint64_t samples_, done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

BufferRows::BufferRows(const SampleBuffer& samples) : samples_(samples) {
  frame_.data_window = samples.data_window;
  frame_.display_window = samples.display_window;
  frame_.layout = samples.layout;
  frame_.half_slots = samples.half_slots;
  frame_.metadata = samples.metadata;
}

std::uint64_t BufferRows::row_samples(int row) const {
  const auto width = static_cast<std::size_t>(frame_.data_window.width);
  const std::uint32_t* first = samples_.first_sample.data() + static_cast<std::size_t>(row) * width;
  return first[width] - first[0];
}

SampleBuffer BufferRows::read(int first, int end) {
  SampleBuffer rows = empty_rows(frame_, first, end);
  const auto width = static_cast<std::size_t>(frame_.data_window.width);
  const std::uint32_t* pixel = samples_.first_sample.data() + static_cast<std::size_t>(first) * width;
  const std::size_t pixels = rows.data_window.pixel_count();
  for (std::size_t p = 1; p <= pixels; ++p) rows.first_sample.push_back(pixel[p] - pixel[0]);
  rows.values.assign(samples_.record(pixel[0]), samples_.record(pixel[pixels]));
  return rows;
}

void for_each_piece(SampleRows& rows, const Control& control,
                    const std::function<void(const SampleBuffer&, int)>& take) {
  Watch watch(control, rows.sample_count());
  for (int first = 0, end = 0; first < rows.frame().data_window.height; first = end) {
    end = rows.end_within(first, piece_bytes);
    const SampleBuffer samples = rows.read(first, end);
    take(samples, first);
    watch.done(samples.sample_count());
  }
}

}  // namespace rpf::io
