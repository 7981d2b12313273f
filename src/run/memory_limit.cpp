#include "run/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "rpf/filter.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), {}};
}

bool has_item(const std::string& list, const std::string& item) {
  return ("," + list + ",").find("," + item + ",") != std::string::npos;
}

/// A mounted hierarchy of groups that can limit memory.
struct Hierarchy {
  bool unified = false;  ///< version 2
  fs::path top;          ///< the group that is mounted: where the hierarchy begins for this process
  fs::path mount;
};

/// From a line of mountinfo: ID, parent, device, top, mount, options, ..., "-", kind, source, more options.
std::vector<Hierarchy> hierarchies(const fs::path& root) {
  std::vector<Hierarchy> result;
  for (const std::string& line : lines_of(root / "proc/self/mountinfo")) {
    const std::vector<std::string> words = words_of(line);
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() < 6 || words.end() - dash < 4) continue;
    const bool unified = dash[1] == "cgroup2";
    if (unified || (dash[1] == "cgroup" && has_item(dash[3], "memory")))
      result.push_back({unified, words[3], words[4]});
  }
  return result;
}

/// The group of this process in a hierarchy, from its top on: in /proc/self/cgroup "4:memory:/job" or "0::/job".
fs::path group_in(const Hierarchy& hierarchy, const fs::path& root) {
  for (const std::string& line : lines_of(root / "proc/self/cgroup")) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (hierarchy.unified ? !controllers.empty() : !has_item(controllers, "memory")) continue;
    const fs::path inside = fs::path(line.substr(second + 1)).lexically_relative(hierarchy.top);
    // Outside of what is mounted, as in some containers: then the top is all there is to see.
    return inside.empty() || *inside.begin() == ".." ? fs::path(".") : inside;
  }
  return ".";
}

/// What a group's file says; "max", or no file, is no limit.
std::uint64_t limit_in(const fs::path& file) {
  std::uint64_t bytes = 0;
  std::ifstream content(file);
  return content >> bytes ? bytes : unlimited;
}

std::uint64_t limit_of(const Hierarchy& hierarchy, const fs::path& root) {
  const char* name = hierarchy.unified ? "memory.max" : "memory.limit_in_bytes";
  fs::path folder = root / hierarchy.mount.relative_path();
  std::uint64_t limit = limit_in(folder / name);
  for (const fs::path& part : group_in(hierarchy, root)) {
    folder /= part;
    limit = std::min(limit, limit_in(folder / name));
  }
  return limit;
}

std::uint64_t machine_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

std::uint64_t resource_limit(int kind) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(kind), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? limit.rlim_cur
             : unlimited;
}

}  // namespace

std::uint64_t control_group_memory(const fs::path& root) {
  std::uint64_t limit = unlimited;
  for (const Hierarchy& hierarchy : hierarchies(root)) limit = std::min(limit, limit_of(hierarchy, root));
  return limit;
}

std::uint64_t available_memory() {
  return std::min(
      {machine_memory(), control_group_memory("/"), resource_limit(RLIMIT_AS), resource_limit(RLIMIT_DATA)});
}

}  // namespace rpf
