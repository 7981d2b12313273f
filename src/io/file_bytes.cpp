#include "io/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "rpf/error.h"

namespace rpf::io {
namespace {

[[noreturn]] void fail_opening(const std::string& path) {
  throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be opened ({}); check the path and its permissions", path,
                                            std::system_category().message(errno)));
}

}  // namespace

FileBytes::FileBytes(const std::string& path) : path_(path) {
  // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) fail_opening(path);
  struct stat status {};
  const bool regular = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular) {
    ::close(descriptor_);
    throw Error(ErrorKind::input,
                fmt::format("\"{}\" is {}, but a regular file is needed; give the path of an image or sample file",
                            path, S_ISDIR(status.st_mode) ? "a folder" : "a device or pipe"));
  }
  // A file that grows while it is read is read up to here.
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileBytes::~FileBytes() { ::close(descriptor_); }

std::size_t FileBytes::read_some(std::uint64_t offset, void* target, std::size_t count) const {
  ssize_t got = 0;
  do got = ::pread(descriptor_, target, count, static_cast<off_t>(offset));
  while (got < 0 && errno == EINTR);
  if (got < 0)
    throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be read ({}); check the disk or copy the file again",
                                              path_, std::system_category().message(errno)));
  return static_cast<std::size_t>(got);
}

std::size_t FileBytes::read_through_block(std::uint64_t offset, void* target, std::size_t count) {
  // Names are read byte by byte: one system call for a block of them.
  if (offset < block_begin_ || offset >= block_begin_ + block_size_) {
    block_size_ = read_some(offset, block_.data(), block_.size());
    block_begin_ = offset;
  }
  const auto skip = static_cast<std::size_t>(offset - block_begin_);
  const std::size_t part = std::min(count, block_size_ - skip);
  std::memcpy(target, block_.data() + skip, part);
  return part;
}

void FileBytes::read(std::uint64_t offset, void* target, std::size_t count, const char* what) {
  auto* out = static_cast<std::uint8_t*>(target);
  while (count > 0) {
    const std::size_t wanted = offset < size_ ? count : 0;
    const std::size_t part =
        wanted >= block_.size() ? read_some(offset, out, wanted) : read_through_block(offset, out, wanted);
    if (part == 0)
      throw Error(ErrorKind::input,
                  fmt::format("\"{}\" is truncated: it ends after {} bytes inside {}; copy or render the file again",
                              path_, size_, what));
    out += part;
    offset += part;
    count -= part;
  }
}

std::uint8_t FileBytes::byte(std::uint64_t offset, const char* what) {
  std::uint8_t value = 0;
  read(offset, &value, 1, what);
  return value;
}

std::uint32_t FileBytes::u32(std::uint64_t offset, const char* what) {
  std::array<std::uint8_t, 4> bytes{};
  read(offset, bytes.data(), bytes.size(), what);
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

std::uint64_t FileBytes::u64(std::uint64_t offset, const char* what) {
  const std::uint64_t low = u32(offset, what);
  return low | static_cast<std::uint64_t>(u32(offset + 4, what)) << 32;
}

}  // namespace rpf::io
