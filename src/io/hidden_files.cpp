#include "io/hidden_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>

namespace rpf::io {
namespace {

namespace fs = std::filesystem;

constexpr std::time_t day = 24 * 60 * 60;  // seconds

/// Name of the machine and a part of the number that its kernel has drawn at its start: machines may share a name.
std::string host() {
  std::array<char, 65> name{};
  ::gethostname(name.data(), name.size() - 1);
  std::string start;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> start;
  std::string text = fmt::format("{}_{}", name.data(), start.substr(0, 8));
  for (char& letter : text)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-') letter = '_';
  return text;
}

const std::string& this_host() {
  static const std::string text = host();
  return text;
}

struct Writer {
  std::string host;
  pid_t process = 0;
};

/// Whose hidden file this is; nothing for all other names.
std::optional<Writer> writer_of(const std::string& name) {
  static const std::regex pattern(R"(\.rpf-(.+)-([0-9]{1,9})-[0-9]{1,9}(\.[^.]*)?)");
  std::smatch parts;
  if (!std::regex_match(name, parts, pattern)) return std::nullopt;
  return Writer{parts[1], std::stoi(parts[2])};
}

bool is_running(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

/// Removes the file unless somebody holds its lock: processes of other containers have other numbers.
void remove_unlocked(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  if (lock_hidden(descriptor, LOCK_NB)) ::unlink(path.c_str());
  ::close(descriptor);
}

bool is_abandoned(const fs::path& path, const Writer& writer, std::time_t now) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  return (writer.host == this_host() && !is_running(writer.process)) || status.st_mtime < now - day;
}

}  // namespace

std::string hidden_name(const std::string& extension) {
  static std::atomic<unsigned> next_number{0};
  return fmt::format(".rpf-{}-{}-{}{}", this_host(), ::getpid(), next_number++, extension);
}

bool lock_hidden(int descriptor, int how) { return ::flock(descriptor, LOCK_EX | how) == 0; }

void remove_abandoned(const std::string& folder, std::time_t now) {
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const auto writer = writer_of(entry->path().filename().string());
    if (writer && is_abandoned(entry->path(), *writer, now)) remove_unlocked(entry->path().string());
  }
}

}  // namespace rpf::io
