#include "opencl/kernel_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "opencl/cache_index.h"
#include "opencl/cache_seal.h"
#include "opencl/cache_size.h"
#include "opencl/environment.h"
#include "rpf/error.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

/// Where the user wants caches; empty where nothing says.
fs::path wanted_folder() {
  if (const std::string own = environment("RPF_CACHE_DIR"); !own.empty()) return fs::path(own) / "pocl";
  if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "rpf" / "pocl";
  if (const std::string home = environment("HOME"); !home.empty()) return fs::path(home) / ".cache" / "rpf" / "pocl";
  return {};
}

/// PoCL ends the process where a disk is full. A program takes half a megabyte, and somewhat more while it is compiled.
constexpr std::uintmax_t needed_space = 16U << 20U;

/// Creates the folder and a file in it: permissions alone do not tell of read-only mounts.
bool is_usable(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || fs::space(folder, failed).available < needed_space || failed) return false;
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

/// The folder that is in use; empty where it is not ours.
fs::path& our_folder() {
  static fs::path folder;
  return folder;
}

/// A folder of the same cache.
fs::path beside_kernels(const char* name) {
  const fs::path kernels = our_folder().empty() ? wanted_folder() : our_folder();
  return kernels.empty() ? fs::path() : kernels.parent_path() / name;
}

void prepare() {
  if (!environment("POCL_CACHE_DIR").empty()) return;
  fs::path folder = wanted_folder();
  if (folder.empty() || !is_usable(folder)) {
    static const PrivateFolder own;
    folder = own.path() / "pocl";
    if (own.path().empty() || !is_usable(folder))
      throw Error(ErrorKind::device, fmt::format("no folder for compiled kernels, not even below {}: {} MB that can be "
                                                 "written to are needed; set RPF_CACHE_DIR, or use --backend=cpu",
                                                 fs::temp_directory_path().string(), needed_space >> 20U));
  }
  our_folder() = folder;
  remove_forgotten_files(folder);
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
}

}  // namespace

void prepare_kernel_cache() {
  static std::once_flag once;
  std::call_once(once, prepare);
}

fs::path kernel_cache_folder() { return our_folder(); }

std::vector<std::string> environment_with_our_cache() {
  constexpr const char* replaced[] = {"RPF_CACHE_DIR=", "POCL_CACHE_DIR="};
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const auto begins = [&](const char* name) { return std::string(*entry).rfind(name, 0) == 0; };
    if (our_folder().empty() || std::none_of(std::begin(replaced), std::end(replaced), begins))
      result.emplace_back(*entry);
  }
  if (!our_folder().empty()) result.push_back("RPF_CACHE_DIR=" + our_folder().parent_path().string());
  return result;
}

fs::path verdict_folder() { return beside_kernels("drivers"); }

fs::path binary_folder() { return beside_kernels("programs"); }

void check_kernels(const std::string& source) {
  if (our_folder().empty()) return;
  const std::vector<fs::path> programs = indexed_programs(our_folder(), source);
  remove_damaged(programs.empty() ? all_programs(our_folder()) : programs);
  for (const fs::path& program : programs) mark_used(program);
}

void keep_compiled_kernels(const std::string& source) {
  if (our_folder().empty()) return;
  static std::map<fs::path, std::string> source_of;  // of the programs that this process has loaded
  std::vector<fs::path> programs;
  for (const fs::path& program : loaded_programs(our_folder()))
    if (source_of.emplace(program, source).first->second == source) programs.push_back(program);
  seal(programs);
  index_programs(our_folder(), source, programs);
}

bool has_compiled_kernels(const std::string& source) {
  return our_folder().empty() || !indexed_programs(our_folder(), source).empty();
}

void prune_programs() {
  constexpr std::uintmax_t limit = std::uintmax_t{512} << 20U;  // hundreds of programs
  std::vector<fs::path> programs = our_folder().empty() ? std::vector<fs::path>() : all_programs(our_folder());
  std::error_code failed;
  for (fs::directory_iterator entry(binary_folder(), failed), end; !failed && entry != end; entry.increment(failed))
    programs.push_back(entry->path());
  prune(programs, limit);
}

}  // namespace rpf
