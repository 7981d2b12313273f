#include "opencl/cache_index.h"

#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include "opencl/cache_file.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

/// One file for each source, with one program a line, relative to the cache folder.
fs::path index_file(const fs::path& folder, const std::string& source) {
  return folder / "rpf-index" / fmt::format("{:016x}", checksum(source));
}

/// <2 letters>/<rest of its hash> of the program that a file in the cache folder belongs to.
fs::path program_of(const fs::path& folder, const fs::path& file) {
  const fs::path inside = file.lexically_relative(folder);
  auto part = inside.begin();
  fs::path program = folder;
  for (int depth = 0; depth < 2 && part != inside.end(); ++depth) program /= *part++;
  return program;
}

struct Search {
  const fs::path& folder;
  std::set<fs::path> programs;
};

int look_at(dl_phdr_info* object, std::size_t /*size*/, void* data) {
  auto& search = *static_cast<Search*>(data);
  const std::string name = object->dlpi_name, inside = search.folder.string() + "/";
  if (name.compare(0, inside.size(), inside) == 0) search.programs.insert(program_of(search.folder, name));
  return 0;
}

}  // namespace

std::vector<fs::path> indexed_programs(const fs::path& folder, const std::string& source) {
  std::vector<fs::path> programs;
  std::ifstream file(index_file(folder, source));
  for (std::string line; std::getline(file, line);) {
    std::error_code failed;
    if (line.empty() || !fs::is_directory(folder / line, failed)) return {};  // removed since, or the index is damaged
    programs.push_back(folder / line);
  }
  return programs;
}

void index_programs(const fs::path& folder, const std::string& source, const std::vector<fs::path>& programs) {
  const std::vector<fs::path> known = indexed_programs(folder, source);
  std::set<fs::path> all(known.begin(), known.end());
  all.insert(programs.begin(), programs.end());
  if (all.size() == known.size()) return;
  std::string lines;
  for (const fs::path& program : all) lines += program.lexically_relative(folder).string() + "\n";
  replace_file(index_file(folder, source), lines);
}

std::vector<fs::path> loaded_programs(const fs::path& folder) {
  Search search{folder, {}};
  dl_iterate_phdr(look_at, &search);
  return {search.programs.begin(), search.programs.end()};
}

}  // namespace rpf
