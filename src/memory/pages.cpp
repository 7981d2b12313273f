#include "memory/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace rpf {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20U;

std::size_t up(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

/// Of whole pages of so many bytes within [begin, end). A kernel that does not know the advice goes on as it was.
void advise(std::uintptr_t begin, std::uintptr_t end, std::size_t page, int advice) {
  const std::uintptr_t first = up(begin, page), last = end / page * page;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, advice);  // NOLINT
}

}  // namespace

void use_large_pages(void* data, std::size_t bytes) {
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
#ifdef MADV_HUGEPAGE
  advise(begin, begin + bytes, large_page, MADV_HUGEPAGE);
#endif
}

void release_tail(std::vector<float>& values) {
  // What is given back reads as zeros afterwards; nothing but a vector that grows again will look.
  advise(reinterpret_cast<std::uintptr_t>(values.data() + values.size()),
         reinterpret_cast<std::uintptr_t>(values.data() + values.capacity()),
         static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), MADV_DONTNEED);
}

LargePages::LargePages(std::size_t bytes)
    : memory_(static_cast<char*>(std::aligned_alloc(large_page, up(bytes, large_page)))) {
  if (!memory_) throw std::bad_alloc();
  use_large_pages(memory_.get(), up(bytes, large_page));
}

void LargePages::Free::operator()(char* memory) const { std::free(memory); }  // NOLINT: of aligned_alloc()

}  // namespace rpf
