#include "io/checked_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "rpf/error.h"

namespace rpf::io {
namespace {

// OpenEXR writes headers and tables a few bytes at a time.
constexpr std::size_t buffer_bytes = std::size_t{1} << 18;

const char* remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free space or choose another folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that may be written to";
    case ENOENT:
    case ENOTDIR:
      return "make the folder first or correct the path";
    default:
      return "check the path and the disk";
  }
}

}  // namespace

CheckedWriter::CheckedWriter(int descriptor, std::string target) : descriptor_(descriptor), target_(std::move(target)) {
  buffer_.reserve(buffer_bytes);
}

// pwrite() instead of write(): the position is ours, whatever others do with the descriptor.
bool CheckedWriter::flush() {
  std::size_t done = 0;
  while (error_ == 0 && done < buffer_.size()) {
    const ssize_t count =
        ::pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done, static_cast<off_t>(position_ + done));
    if (count > 0) done += static_cast<std::size_t>(count);
    if (count == 0) error_ = ENOSPC;  // no progress and no reason given
    if (count < 0 && errno != EINTR) error_ = errno;
  }
  position_ += buffer_.size();
  buffer_.clear();
  size_ = std::max(size_, position_);
  return error_ == 0;
}

bool CheckedWriter::write(const void* data, std::size_t count) {
  const char* bytes = static_cast<const char*>(data);
  while (count > 0 && error_ == 0) {
    const std::size_t part = std::min(count, buffer_bytes - buffer_.size());
    buffer_.insert(buffer_.end(), bytes, bytes + part);
    bytes += part;
    count -= part;
    if (buffer_.size() == buffer_bytes) flush();
  }
  return error_ == 0;
}

bool CheckedWriter::seek(std::uint64_t position) {
  flush();
  position_ = position;
  return error_ == 0;
}

void CheckedWriter::finish() {
  if (!flush()) fail_writing(target_, error_);
}

void fail_writing(const std::string& target, int error_number) {
  throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written ({}); {}", target,
                                             std::system_category().message(error_number), remedy(error_number)));
}

}  // namespace rpf::io
