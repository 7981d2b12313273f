#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "io/checked_writer.h"
#include "io/hidden_files.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

namespace fs = std::filesystem;

// Of a new file, before the umask; a file that replaces another is the writer's alone until it gets the other's rights.
constexpr mode_t new_rights = 0666, private_rights = 0600;

void sync_folder(const std::string& target, const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written to but not read: the rename itself is done
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  // Some network file systems cannot sync folders and say EINVAL.
  if (result != 0 && error != EINVAL && error != ENOTSUP) fail_writing(target, error);
}

// Whether `path` still names the open file: between its creation and its lock another process may have cleaned up.
bool is_in_place(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& target) : target_(target), place_(output_place(target)) {
  do {
    close();
    make();
  } while (lock_hidden(descriptor_, 0) && !is_in_place(descriptor_, temporary_));
  struct stat made {};
  // The time of the new file is the time of the folder's file system, which may be another machine's.
  if (::fstat(descriptor_, &made) == 0) remove_abandoned(folder_of(place_.path), made.st_mtime);
}

void AtomicFile::make() {
  const fs::path folder = folder_of(place_.path);
  const std::string extension = fs::path(place_.path).extension().string();
  do {
    temporary_ = (folder / hidden_name(extension)).string();
    const mode_t rights = place_.old ? private_rights : new_rights;
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, rights);
    if (descriptor_ < 0 && errno != EEXIST) fail(errno);
  } while (descriptor_ < 0);
}

AtomicFile::~AtomicFile() {
  close();
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void AtomicFile::fail(int error_number) const {
  fail_writing(target_ == place_.path ? target_ : fmt::format("{}\" -> \"{}", target_, place_.path), error_number);
}

void AtomicFile::commit() {
  if (place_.old) take_over(descriptor_, place_.path, *place_.old);
  // Without it a power cut could leave the new name with an empty file.
  if (::fsync(descriptor_) != 0) fail(errno);
  // Closed afterwards: the lock holds until the file has its name.
  if (std::rename(temporary_.c_str(), place_.path.c_str()) != 0) fail(errno);
  temporary_.clear();  // nothing left to remove
  close();
  sync_folder(target_, folder_of(place_.path));
}

}  // namespace rpf::io
