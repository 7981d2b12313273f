#include "opencl/binaries.h"

#include <fmt/format.h>

#include <system_error>

#include "opencl/cache_file.h"
#include "opencl/cache_size.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

/// What a file begins with: of which source and content it is.
std::string seal_of(const std::string& source, const std::string& content) {
  return fmt::format("rpf binary {:016x} {:016x}\n", checksum(source), checksum(content));
}

}  // namespace

fs::path Binaries::file_of(const std::string& source) const {
  return folder_ / fmt::format("{:016x}", checksum(source));
}

std::string Binaries::read(const std::string& source) const {
  if (folder_.empty()) return {};
  const fs::path path = file_of(source);
  const std::string file = content_of(path);
  const std::size_t end = file.find('\n') + 1;
  if (end > 0 && file.substr(0, end) == seal_of(source, file.substr(end))) {
    mark_used(path);
    return file;
  }
  std::error_code failed;
  fs::remove(path, failed);
  return {};
}

bool Binaries::has(const std::string& source) const { return !read(source).empty(); }

Binaries::Binary Binaries::find(const std::string& source) const {
  const std::string file = read(source);
  return {file.begin() + static_cast<std::ptrdiff_t>(file.find('\n') + 1), file.end()};
}

void Binaries::keep(const std::string& source, const Binary& binary) const {
  if (folder_.empty()) return;
  const std::string content(binary.begin(), binary.end());
  replace_file(file_of(source), seal_of(source, content) + content);
}

}  // namespace rpf
