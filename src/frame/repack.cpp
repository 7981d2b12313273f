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

std::pair<std::size_t, std::size_t> RepackOrder::pieces_below(std::size_t turn) const {
  const auto [first, end] = records(turn);
  const std::size_t values = piece_records * from_;
  return {first * width_ / values, std::min((end * width_ - 1) / values, pieces() - 1)};
}

bool RepackOrder::is_free(std::size_t turn) const {
  const auto [first, last] = pieces_below(turn);
  bool is_free = true;
  for (std::size_t piece = first; in_place_ && is_free && piece <= last; ++piece) is_free = is_taken(piece);
  return is_free;
}

bool RepackOrder::may_write(std::size_t turn) {
  taken_[records(turn).first / piece_records].store(true, std::memory_order_release);
  if (!in_place_) return true;
  const auto [first, last] = pieces_below(turn);
  for (std::size_t piece = first; piece <= last; ++piece)
    while (!is_taken(piece)) {  // soon: its turn came earlier
      if (must_stop()) return false;
      std::this_thread::yield();
    }
  return true;
}

}  // namespace rpf
