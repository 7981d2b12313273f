// Joins renderings of one frame, some rows at a time.
#include <utility>

#include "frame/merge.h"
#include "rpf/error.h"
#include "rpf/rows.h"

namespace rpf {
namespace {

class MergedRows final : public SampleRows {
 public:
  explicit MergedRows(std::vector<RowsPart> parts) : parts_(std::move(parts)) {
    std::vector<SamplePart> frames;
    for (const RowsPart& part : parts_) frames.push_back({part.name, part.rows->frame()});
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      check_alike(frames.front(), frames[i]);
      total += parts_[i].rows->sample_count();
    }
    check_total(frames.front().name, total);
    for (std::size_t b = 1; b < frames.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) check_repetition(a, b, frames);
    frame_ = frames.front().samples;
    frame_.metadata = merged_metadata(frames);
  }

  const SampleBuffer& frame() const override { return frame_; }

  std::uint64_t row_samples(int row) const override {
    std::uint64_t samples = 0;
    for (const RowsPart& part : parts_) samples += part.rows->row_samples(row);
    return samples;
  }

  SampleBuffer read(int first, int end) override {
    std::vector<SamplePart> read;
    for (const RowsPart& part : parts_) read.push_back({part.name, part.rows->read(first, end)});
    SampleBuffer merged = joined(std::move(read));
    merged.metadata = frame_.metadata;
    return merged;
  }

 private:
  /// Reads rows until two differ.
  void check_repetition(std::size_t a, std::size_t b, const std::vector<SamplePart>& frames) {
    Repetition repetition;
    for (int row = 0; row < frames.front().samples.data_window.height && repetition.everywhere; ++row)
      repetition.look(parts_[a].rows->read(row, row + 1), in_order(parts_[b].rows->read(row, row + 1), frames[a]));
    repetition.check(frames[a], frames[b]);
  }

  /// With the slots in the order of another part.
  static SampleBuffer in_order(SampleBuffer samples, const SamplePart& other) {
    reorder(samples, other.samples.layout);
    return samples;
  }

  std::vector<RowsPart> parts_;
  SampleBuffer frame_;
};

}  // namespace

std::unique_ptr<SampleRows> merge_rows(std::vector<RowsPart> parts) {
  if (parts.empty()) throw Error(ErrorKind::usage, "merge_rows: one or more renderings are expected");
  return std::make_unique<MergedRows>(std::move(parts));
}

}  // namespace rpf
