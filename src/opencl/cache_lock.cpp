#include "opencl/cache_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <thread>

#include "opencl/cache_file.h"
#include "opencl/kernel_cache.h"

namespace rpf {
namespace {

/// Negative where there is no file to lock.
int open_lock(const std::string& name) {
  const std::filesystem::path folder = verdict_folder();
  if (folder.empty()) return -1;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  // Closed in the child and in the linker that PoCL starts, which would hold it otherwise.
  return ::open((folder / fmt::format("{:016x}.lock", checksum(name))).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
}

}  // namespace

CacheLock::CacheLock(const std::string& name) : descriptor_(open_lock(name)) {}

CacheLock::CacheLock(const std::string& name, std::chrono::seconds limit, const Check& check) : CacheLock(name) {
  constexpr auto pause = std::chrono::milliseconds(20);
  const auto end = std::chrono::steady_clock::now() + limit;
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK &&
         std::chrono::steady_clock::now() < end) {
    if (check) check();
    std::this_thread::sleep_for(pause);
  }
}

CacheLock::~CacheLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace rpf
