#include "run/control_groups.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace rpf {
namespace {

namespace fs = std::filesystem;

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

/// A mounted hierarchy of groups that can limit what a controller is for.
struct Hierarchy {
  bool unified = false;  ///< version 2
  fs::path top;          ///< the group that is mounted: where the hierarchy begins for this process
  fs::path mount;
};

/// From a line of mountinfo: ID, parent, device, top, mount, options, ..., "-", kind, source, more options.
std::vector<Hierarchy> hierarchies(const fs::path& root, const std::string& controller) {
  std::vector<Hierarchy> result;
  for (const std::string& line : lines_of(root / "proc/self/mountinfo")) {
    const std::vector<std::string> words = words_of(line);
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() < 6 || words.end() - dash < 4) continue;
    const bool unified = dash[1] == "cgroup2";
    if (unified || (dash[1] == "cgroup" && has_item(dash[3], controller)))
      result.push_back({unified, words[3], words[4]});
  }
  return result;
}

/// The group of this process in a hierarchy, from its top on: in /proc/self/cgroup "4:memory:/job" or "0::/job".
fs::path group_in(const Hierarchy& hierarchy, const fs::path& root, const std::string& controller) {
  for (const std::string& line : lines_of(root / "proc/self/cgroup")) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (hierarchy.unified ? !controllers.empty() : !has_item(controllers, controller)) continue;
    const fs::path inside = fs::path(line.substr(second + 1)).lexically_relative(hierarchy.top);
    // Outside of what is mounted, as in some containers: then the top is all there is to see.
    return inside.empty() || *inside.begin() == ".." ? fs::path(".") : inside;
  }
  return ".";
}

struct Group {
  fs::path folder;
  bool unified = false;
};

/// The groups of this process that a controller can limit: its own and those above it, of every hierarchy.
std::vector<Group> groups(const fs::path& root, const std::string& controller) {
  std::vector<Group> result;
  for (const Hierarchy& hierarchy : hierarchies(root, controller)) {
    fs::path folder = root / hierarchy.mount.relative_path();
    result.push_back({folder, hierarchy.unified});
    for (const fs::path& part : group_in(hierarchy, root, controller))
      result.push_back({folder /= part, hierarchy.unified});
  }
  return result;
}

/// The first number in a file; none where there is no file, or a word: "max".
std::optional<std::int64_t> number_in(const fs::path& file) {
  std::int64_t number = 0;
  std::ifstream content(file);
  return content >> number ? std::optional(number) : std::nullopt;
}

/// Processors, a part of one too: what is had in a period over its length, in microseconds. 0 without a limit.
double quota_of(const Group& group) {
  std::optional<std::int64_t> quota, period;
  if (group.unified) {
    const std::vector<std::string> lines = lines_of(group.folder / "cpu.max");  // "150000 100000", "max 100000"
    std::istringstream words(lines.empty() ? "" : lines.front());
    if (std::int64_t a = 0, b = 0; words >> a >> b) quota = a, period = b;
  } else {
    quota = number_in(group.folder / "cpu.cfs_quota_us");  // -1: none
    period = number_in(group.folder / "cpu.cfs_period_us");
  }
  const bool limited = quota.value_or(0) > 0 && period.value_or(0) > 0;
  return limited ? static_cast<double>(*quota) / static_cast<double>(*period) : 0;
}

}  // namespace

std::uint64_t control_group_memory(const fs::path& root) {
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  for (const Group& group : groups(root, "memory"))
    if (const auto bytes = number_in(group.folder / (group.unified ? "memory.max" : "memory.limit_in_bytes")))
      limit = std::min(limit, static_cast<std::uint64_t>(std::max<std::int64_t>(*bytes, 0)));
  return limit;
}

int control_group_threads(const fs::path& root) {
  double least = std::numeric_limits<int>::max();
  for (const Group& group : groups(root, "cpu"))
    if (const double quota = quota_of(group); quota > 0) least = std::min(least, std::ceil(quota));
  return static_cast<int>(least);
}

}  // namespace rpf
