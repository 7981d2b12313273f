#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "io/checked_writer.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

namespace fs = std::filesystem;

// Distinguishes the temporary files of one process.
std::atomic<unsigned> next_number{0};

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// The file that a symbolic link stands for. The temporary file is made beside it: a rename cannot cross disks.
std::string behind_links(const std::string& target) {
  std::error_code error;
  if (!fs::is_symlink(target, error)) return target;
  const fs::path place = fs::weakly_canonical(target, error);
  return error ? target : place.string();
}

// What renaming onto `place` would replace.
void check_existing(const std::string& target, const std::string& place) {
  if (target.empty()) throw Error(ErrorKind::usage, "the output path is empty; give the name of a file to write");
  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw Error(ErrorKind::output,
              fmt::format("\"{}\" is {}, but a result must be a regular file; give the name of a file", target,
                          fs::is_directory(status) ? "a folder" : "a device or pipe"));
}

void sync_folder(const std::string& target, const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written to but not read: the rename itself is done
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  // Some network file systems cannot sync folders and say EINVAL.
  if (result != 0 && error != EINVAL && error != ENOTSUP) fail_writing(target, error);
}

// Who writes a temporary file holds a lock on it, which ends with the process: a temporary file that can be locked was
// left by one that was killed. A file system without locks is none to clean up in.
bool lock(int descriptor, int how) { return ::flock(descriptor, LOCK_EX | how) == 0; }

// Whether `path` still names the open file: between its creation and its lock another process may have cleaned up.
bool is_in_place(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

void remove_if_left(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  if (lock(descriptor, LOCK_NB)) ::unlink(path.c_str());
  ::close(descriptor);
}

// .rpf-<pid>-<n><extension>
bool is_temporary(const std::string& name) {
  int process = 0, number = 0, end = 0;
  if (std::sscanf(name.c_str(), ".rpf-%9d-%9d%n", &process, &number, &end) != 2) return false;
  const std::string rest = name.substr(static_cast<std::size_t>(end));
  return process > 0 && number >= 0 && (rest.empty() || (rest[0] == '.' && rest.find('.', 1) == std::string::npos));
}

void remove_what_was_left(const fs::path& folder) {
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (is_temporary(name)) remove_if_left(entry->path().string());
  }
}

}  // namespace

AtomicFile::AtomicFile(const std::string& target) : target_(target), place_(behind_links(target)) {
  check_existing(target_, place_);
  const fs::path folder = folder_of(place_);
  remove_what_was_left(folder);
  const std::string extension = fs::path(place_).extension().string();
  do {
    close();
    const std::string name = fmt::format(".rpf-{}-{}{}", ::getpid(), next_number++, extension);
    temporary_ = (folder / name).string();
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail_writing(target_, errno);
  } while (descriptor_ < 0 || (lock(descriptor_, 0) && !is_in_place(descriptor_, temporary_)));
}

AtomicFile::~AtomicFile() {
  close();
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void AtomicFile::commit() {
  // Without it a power cut could leave the new name with an empty file.
  if (::fsync(descriptor_) != 0) fail_writing(target_, errno);
  // Closed afterwards: the lock holds until the file has its name.
  if (std::rename(temporary_.c_str(), place_.c_str()) != 0) fail_writing(target_, errno);
  temporary_.clear();  // nothing left to remove
  close();
  sync_folder(target_, folder_of(place_));
}

}  // namespace rpf::io
