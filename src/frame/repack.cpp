#include "frame/repack.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace rpf {

void release_tail(std::vector<float>& values) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.size());
  const auto capacity = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity());
  const std::uintptr_t first = (end + page - 1) / page * page, last = capacity / page * page;
  // What is given back reads as zeros afterwards; nothing but a vector that grows again will look.
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);  // NOLINT
}

}  // namespace rpf
