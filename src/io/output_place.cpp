#include "io/output_place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>

#include "io/checked_writer.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;                 // as Linux follows
constexpr auto keep = static_cast<uid_t>(-1);  // owner or group, for fchown()

[[noreturn]] void refuse(const std::string& target, const std::string& what) {
  throw Error(ErrorKind::output, fmt::format("\"{}\" {}", target, what));
}

/// What the links lead to, also where nothing is there yet. The circle of links is Linux's own error.
std::string behind_links(const std::string& target) {
  fs::path place = target;
  for (int links = 0; links < most_links; ++links) {
    std::error_code no_link;
    const fs::path next = fs::read_symlink(place, no_link);
    if (no_link) return place.string();
    place = next.is_absolute() ? next : place.parent_path() / next;
  }
  fail_writing(target, ELOOP);
}

std::optional<struct stat> status_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

const char* kind_of(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) return "a folder";
  return S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode) ? "a pipe or socket" : "a device";
}

/// A file that is mounted by itself, as containers do, cannot be renamed onto.
bool is_mounted(const std::string& path) {
  struct statx status {};
  return ::statx(AT_FDCWD, path.c_str(), 0, STATX_BASIC_STATS, &status) == 0 &&
         (status.stx_attributes_mask & status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// In a folder such as /tmp only the owners of file and folder may replace a file.
bool is_kept_by_its_folder(const std::string& path, const struct stat& file) {
  const auto folder = status_of(folder_of(path));
  const uid_t user = ::geteuid();
  return folder && (folder->st_mode & S_ISVTX) != 0 && user != 0 && user != file.st_uid && user != folder->st_uid;
}

void check_replaceable(const std::string& target, const std::string& path, const struct stat& old) {
  // Root may write to anything; a file that nobody may write to is meant to stay all the same.
  if ((old.st_mode & 0222) == 0 || ::access(path.c_str(), W_OK) != 0)
    refuse(target, fmt::format("exists and is write-protected (mode {:04o}); make it writable or name another file",
                               old.st_mode & 07777));
  if (is_mounted(path)) refuse(target, "is mounted as a file of its own and cannot be replaced; name a file beside it");
  if (is_kept_by_its_folder(path, old))
    refuse(target, "belongs to somebody else, and its folder lets only owners replace files; name another file");
}

bool is_one_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

}  // namespace

std::string OutputPlace::identity() const {
  const auto number_of = [](const struct stat& status) { return fmt::format("{}:{}", status.st_dev, status.st_ino); };
  // A file with one link may have two names: where its folder takes capital and small letters for the same.
  if (old && old->st_nlink == 1) return number_of(*old);
  if (const auto folder = status_of(folder_of(path)))
    return fmt::format("{}/{}", number_of(*folder), fs::path(path).filename().string());
  std::error_code unknown;  // in a folder that is still to be made
  return fs::weakly_canonical(path, unknown).string();
}

OutputPlace output_place(const std::string& target) {
  if (target.empty()) throw Error(ErrorKind::usage, "the output path is empty; give the name of a file to write");
  // First what the system finds: links of /proc/self/fd lead to pipes that have no path.
  const auto found = status_of(target);
  if (found && !S_ISREG(found->st_mode))
    refuse(target, fmt::format("is {}, but a result must be a regular file; give the name of a file", kind_of(*found)));
  OutputPlace place{behind_links(target), found};
  const auto there = status_of(place.path);
  if (found.has_value() != there.has_value() || (found && !is_one_file(*found, *there)))
    refuse(target, "is a link that cannot be followed; name the file itself");
  if (found) check_replaceable(target, place.path, *found);
  return place;
}

OutputPlace input_place(const std::string& path) { return {behind_links(path), status_of(path)}; }

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

void take_over(int descriptor, const std::string& old_path, const struct stat& old) {
  struct stat made {};
  const bool known = ::fstat(descriptor, &made) == 0;
  const bool same_group = (known && made.st_gid == old.st_gid) || ::fchown(descriptor, keep, old.st_gid) == 0;
  // Only root may give files away; for others the new file is theirs.
  [[maybe_unused]] const bool same_owner =
      (known && made.st_uid == old.st_uid) || ::fchown(descriptor, old.st_uid, keep) == 0;
  const mode_t rights = old.st_mode & 0777;
  ::fchmod(descriptor, same_group ? rights : (rights & 0707) | ((rights & 07) << 3));
  constexpr const char* access_list = "system.posix_acl_access";
  std::array<char, 4096> list{};
  const ssize_t size = ::getxattr(old_path.c_str(), access_list, list.data(), list.size());
  if (same_group && size > 0) ::fsetxattr(descriptor, access_list, list.data(), static_cast<std::size_t>(size), 0);
}

}  // namespace rpf::io
