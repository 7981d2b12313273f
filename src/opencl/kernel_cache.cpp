#include "opencl/kernel_cache.h"

#include <elf.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <system_error>

namespace rpf {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

/// Where the user wants caches; empty where nothing says.
fs::path wanted_folder() {
  if (const std::string own = environment("RPF_CACHE_DIR"); !own.empty()) return fs::path(own) / "pocl";
  if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "rpf" / "pocl";
  if (const std::string home = environment("HOME"); !home.empty()) return fs::path(home) / ".cache" / "rpf" / "pocl";
  return {};
}

/// Creates the folder and a file in it: permissions alone do not tell of full disks and read-only mounts.
bool is_writable(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return false;
  const fs::path probe = folder / (".rpf-probe-" + std::to_string(getpid()));
  bool written = false;
  {
    std::ofstream file(probe);
    written = (file << "probe").flush().good();
  }
  fs::remove(probe, failed);
  return written;
}

/// A folder of this process alone, removed with it.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string path = (fs::temp_directory_path() / "rpf-cache-XXXXXX").string();
    if (mkdtemp(path.data()) != nullptr) path_ = path;
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A shared object ends with its section headers, so a truncated one lacks them.
bool is_whole_shared_object(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!file || std::string(reinterpret_cast<const char*>(header.e_ident), SELFMAG) != ELFMAG) return false;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  return !failed && header.e_shoff + std::uintmax_t{header.e_shnum} * header.e_shentsize <= size;
}

/// PoCL loads a damaged kernel without a look and dies of it. Files of the last seconds may be still in the making.
void remove_damaged_kernels(const fs::path& folder) {
  constexpr auto settled = std::chrono::seconds(10);
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (entry->path().extension() != ".so") continue;
    const auto age = fs::file_time_type::clock::now() - entry->last_write_time(failed);
    if (failed || age < settled || is_whole_shared_object(entry->path())) continue;
    fs::remove(entry->path(), failed);
  }
}

void prepare() {
  if (!environment("POCL_CACHE_DIR").empty()) return;
  fs::path folder = wanted_folder();
  if (folder.empty() || !is_writable(folder)) {
    static const PrivateFolder own;
    folder = own.path();
  }
  if (folder.empty()) return;  // PoCL's own default is as good as anything then
  remove_damaged_kernels(folder);
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
}

}  // namespace

void prepare_kernel_cache() {
  static std::once_flag once;
  std::call_once(once, prepare);
}

}  // namespace rpf
