#include "opencl/cache_size.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace rpf {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes = 0;
};

/// Another process may be removing it just now.
std::uintmax_t bytes_of_file(const fs::path& file) {
  std::error_code gone;
  const std::uintmax_t bytes = fs::is_regular_file(file, gone) ? fs::file_size(file, gone) : 0;
  return gone ? 0 : bytes;
}

std::uintmax_t bytes_of(const fs::path& path) {
  std::uintmax_t bytes = bytes_of_file(path);
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(path, failed), end; !failed && entry != end; entry.increment(failed))
    bytes += bytes_of_file(entry->path());
  return bytes;
}

}  // namespace

void prune(const std::vector<fs::path>& paths, std::uintmax_t limit) {
  const auto in_use_since = fs::file_time_type::clock::now() - std::chrono::hours(1);
  std::vector<Entry> entries;
  std::uintmax_t bytes = 0;
  std::error_code failed;
  for (const fs::path& path : paths) {
    entries.push_back({path, fs::last_write_time(path, failed), bytes_of(path)});
    bytes += entries.back().bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (bytes <= limit || entry.used > in_use_since) return;
    fs::remove_all(entry.path, failed);
    bytes -= entry.bytes;
  }
}

void mark_used(const fs::path& entry) {
  std::error_code failed;
  fs::last_write_time(entry, fs::file_time_type::clock::now(), failed);
}

}  // namespace rpf
