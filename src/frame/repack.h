// Records of another width in the place of those that were read.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "frame/column_block.h"
#include "parallel/workers.h"
#include "rpf/samples.h"

namespace rpf {

/// Gives the memory behind the last element back: shrink_to_fit() would copy, and need both at once.
void release_tail(std::vector<float>& values);

/// Records that a thread makes at once.
constexpr std::size_t piece_records = 16 * block_records;

struct RepackScratch {
  ColumnBlock block;
  std::vector<float> made;
};

/// In which order pieces of records are made so that none is written over one that is still to be read.
class RepackOrder {
 public:
  /// Records of `from` values become records of `width`, where those lie or elsewhere.
  RepackOrder(std::size_t count, std::size_t from, std::size_t width, bool in_place);

  std::size_t pieces() const { return taken_.size(); }
  /// The records first .. end - 1 whose turn it is: of longer ones the last come first.
  std::pair<std::size_t, std::size_t> records(std::size_t turn) const;
  /// Whether nothing is left to be read where those are to be written: they need not be made elsewhere first.
  bool is_free(std::size_t turn) const;
  /// Says that those were read, and waits until all were that lie where they are to be written. Turns are taken in
  /// ascending order. False: the work is to end.
  bool may_write(std::size_t turn);

 private:
  /// The first and the last piece that lie where those records are to be written.
  std::pair<std::size_t, std::size_t> pieces_below(std::size_t turn) const;
  bool is_taken(std::size_t piece) const { return taken_[piece].load(std::memory_order_acquire); }

  std::size_t count_, from_, width_;
  bool in_place_;
  std::vector<std::atomic<bool>> taken_;  ///< [piece]
};

/// Records of `width` values in the place of the buffer's own where there is room; its values are gone afterwards.
/// `make(records, to)` writes those of a block, which has the columns that `records` was made for; on so many threads.
template <typename Make>
std::vector<float> repack(SampleBuffer& samples, std::size_t width, const ColumnBlock& records, int threads,
                          const Make& make) {
  const std::size_t count = samples.sample_count(), from = samples.layout.size();
  std::vector<float> elsewhere;
  const bool in_place = count * width <= samples.values.capacity();
  std::vector<float>& target = in_place ? samples.values : elsewhere;
  target.resize(count * std::max(in_place ? from : 0, width));
  RepackOrder order(count, from, width, in_place);
  Workers workers(threads);
  std::vector<RepackScratch> scratch(workers.count(), {records, std::vector<float>(piece_records * width)});
  workers.for_all(0, order.pieces(), [&](std::size_t turn, std::size_t worker) {
    const auto [first, end] = order.records(turn);
    RepackScratch& own = scratch[worker];
    float* const place = target.data() + first * width;
    float* const made = order.is_free(turn) ? place : own.made.data();
    for (std::size_t i = first; i < end; i += block_records) {
      own.block.take(samples.values.data() + i * from, std::min(block_records, end - i));
      make(static_cast<const ColumnBlock&>(own.block), made + (i - first) * width);
    }
    if (order.may_write(turn) && made != place) std::copy_n(made, (end - first) * width, place);
  });
  target.resize(count * width);
  release_tail(target);
  return std::move(target);
}

}  // namespace rpf
