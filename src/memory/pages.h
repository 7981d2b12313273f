// Pages of memory: each that is touched for the first time costs a page fault, a tenth of a fast run, and threads wait
// for each other in it.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace rpf {

/// Asks for pages of 2 MB for what lies there and was not touched yet; does nothing where there are none.
void use_large_pages(void* data, std::size_t bytes);

/// Gives the memory behind the last element back: shrink_to_fit() would copy, and need both at once.
void release_tail(std::vector<float>& values);

/// Memory in pages of 2 MB. Throws std::bad_alloc.
class LargePages {
 public:
  LargePages() = default;
  explicit LargePages(std::size_t bytes);
  char* data() const { return memory_.get(); }

 private:
  struct Free {
    void operator()(char* memory) const;
  };
  std::unique_ptr<char, Free> memory_;
};

}  // namespace rpf
