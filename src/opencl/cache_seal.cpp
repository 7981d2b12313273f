#include "opencl/cache_seal.h"

#include <elf.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "opencl/cache_file.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

// PoCL keeps a program in <folder>/<2 letters>/<rest of its hash>: program.bc and one .so for each kernel. It makes
// each file under a temporary name and renames it.
constexpr const char* seal_name = "rpf-seal";

bool is_compiled(const fs::path& path) { return path.extension() == ".so" || path.extension() == ".bc"; }

std::vector<fs::path> compiled_files(const fs::path& program) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(program, failed), end; !failed && entry != end; entry.increment(failed))
    if (is_compiled(entry->path())) files.push_back(entry->path());
  return files;
}

/// Checksums by file name relative to the program; empty where it has no seal.
std::map<std::string, std::uint64_t> read_seal(const fs::path& program) {
  std::map<std::string, std::uint64_t> seal;
  std::ifstream file(program / seal_name);
  std::uint64_t sum = 0;
  for (std::string name; file >> sum && std::getline(file >> std::ws, name);) seal[name] = sum;
  return seal;
}

/// A shared object ends with its section headers, so a truncated one lacks them.
bool is_whole_shared_object(const std::string& content) {
  Elf64_Ehdr header{};
  if (content.size() < sizeof header || content.compare(0, SELFMAG, ELFMAG) != 0) return false;
  content.copy(reinterpret_cast<char*>(&header), sizeof header);
  return header.e_shoff + std::uint64_t{header.e_shnum} * header.e_shentsize <= content.size();
}

bool looks_whole(const fs::path& path, const std::string& content) {
  return path.extension() == ".so" ? is_whole_shared_object(content) : content.compare(0, 2, "BC") == 0;
}

bool is_damaged(const fs::path& program) {
  const auto seal = read_seal(program);
  for (const fs::path& path : compiled_files(program)) {
    const std::string content = content_of(path);
    const auto sealed = seal.find(path.lexically_relative(program).string());
    if (sealed != seal.end() ? sealed->second != checksum(content) : !looks_whole(path, content)) return true;
  }
  return false;
}

bool is_sealed(const fs::path& program, const std::vector<fs::path>& files) {
  const auto seal = read_seal(program);
  for (const fs::path& path : files)
    if (seal.count(path.lexically_relative(program).string()) == 0) return false;
  return true;
}

}  // namespace

std::vector<fs::path> all_programs(const fs::path& folder) {
  std::vector<fs::path> result;
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry.depth() == 1 && entry->is_directory(failed)) {
      result.push_back(entry->path());
      entry.disable_recursion_pending();
    }
  return result;
}

void seal(const std::vector<fs::path>& programs) {
  for (const fs::path& program : programs) {
    const std::vector<fs::path> files = compiled_files(program);
    if (is_sealed(program, files)) continue;
    std::string record;
    for (const fs::path& path : files)
      record += fmt::format("{} {}\n", checksum(content_of(path)), path.lexically_relative(program).string());
    replace_file(program / seal_name, record);
  }
}

void remove_damaged(const std::vector<fs::path>& programs) {
  std::error_code failed;
  for (const fs::path& program : programs)
    if (is_damaged(program)) fs::remove_all(program, failed);
}

void remove_forgotten_files(const fs::path& folder) {
  constexpr auto forgotten = std::chrono::hours(1);
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (entry->path().filename().string().rfind("tempfile_", 0) != 0) continue;
    std::error_code gone;  // another process cleans too
    const auto age = fs::file_time_type::clock::now() - entry->last_write_time(gone);
    if (!gone && age > forgotten) fs::remove(entry->path(), gone);
  }
}

}  // namespace rpf
