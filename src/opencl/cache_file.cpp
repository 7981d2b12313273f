#include "opencl/cache_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace rpf {

namespace fs = std::filesystem;

std::uint64_t checksum(const std::string& content) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

std::string content_of(const fs::path& path) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  std::string content(failed ? 0 : size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return content;
}

void replace_file(const fs::path& path, const std::string& content) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  const fs::path temporary = path.string() + fmt::format("-{}", ::getpid());
  std::ofstream file(temporary, std::ios::binary);
  file << content;
  file.close();
  if (file.good()) fs::rename(temporary, path, failed);
  if (failed || !file.good()) fs::remove(temporary, failed);
}

}  // namespace rpf
