#include "opencl/address_space.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>

#include "rpf/error.h"

namespace rpf {
namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;
constexpr std::size_t driver_bytes = 450 * megabyte, compiler_bytes = 400 * megabyte;
constexpr std::size_t stack_bytes = 10 * megabyte;  // of a thread: 8 MB by default, and what else one takes

bool is_limited() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

bool is_free(std::size_t bytes) {
  void* place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  ::munmap(place, bytes);
  return true;
}

void check(std::size_t bytes) {
  if (is_limited() && !is_free(bytes))
    throw Error(
        ErrorKind::device,
        fmt::format("OpenCL needs {} MB of address space more than `ulimit -v` leaves; raise that limit, filter "
                    "a smaller frame, or use --backend=cpu",
                    bytes / megabyte));
}

}  // namespace

void check_address_space_to_start() {
  const auto cores = static_cast<std::size_t>(::sysconf(_SC_NPROCESSORS_ONLN));
  check(driver_bytes + compiler_bytes + cores * stack_bytes);
}

void check_address_space_to_compile() { check(compiler_bytes); }

}  // namespace rpf
