#include "frame/repack.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <thread>

namespace rpf {

void release_tail(std::vector<float>& values) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.size());
  const auto capacity = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity());
  const std::uintptr_t first = (end + page - 1) / page * page, last = capacity / page * page;
  // What is given back reads as zeros afterwards; nothing but a vector that grows again will look.
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);  // NOLINT
}

RepackOrder::RepackOrder(std::size_t count, std::size_t from, std::size_t width, bool in_place)
    : count_(count),
      from_(from),
      width_(width),
      in_place_(in_place),
      taken_((count + piece_records - 1) / piece_records) {}

std::pair<std::size_t, std::size_t> RepackOrder::records(std::size_t turn) const {
  const std::size_t first = (width_ > from_ ? pieces() - 1 - turn : turn) * piece_records;
  return {first, std::min(first + piece_records, count_)};
}

bool RepackOrder::may_write(std::size_t turn) {
  const auto [first, end] = records(turn);
  taken_[first / piece_records].store(true, std::memory_order_release);
  if (!in_place_) return true;
  const std::size_t last_piece = std::min((end * width_ - 1) / (piece_records * from_), pieces() - 1);
  for (std::size_t piece = first * width_ / (piece_records * from_); piece <= last_piece; ++piece)
    while (!taken_[piece].load(std::memory_order_acquire)) {  // soon: its turn came earlier
      if (must_stop()) return false;
      std::this_thread::yield();
    }
  return true;
}

}  // namespace rpf
