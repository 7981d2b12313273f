// A buffered writer that loses no error. OpenEXR and OpenImageIO swallow failed writes in their destructors; they write
// through this one, which remembers the first failure until finish() reports it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rpf::io {

class CheckedWriter {
 public:
  /// Writes to `descriptor`, which stays open and belongs to the caller. `target` is the file's name in errors.
  CheckedWriter(int descriptor, std::string target);
  CheckedWriter(const CheckedWriter&) = delete;
  CheckedWriter& operator=(const CheckedWriter&) = delete;

  /// False after the first failure, and from then on.
  bool write(const void* data, std::size_t count);
  bool seek(std::uint64_t position);
  std::uint64_t position() const { return position_ + buffer_.size(); }
  std::uint64_t size() const { return std::max(size_, position()); }
  bool failed() const { return error_ != 0; }

  /// Writes what is buffered and throws Error(output) for the first failure since construction.
  void finish();

 private:
  bool flush();

  int descriptor_;
  std::string target_;
  std::vector<char> buffer_;
  std::uint64_t position_ = 0;  ///< in the file, of the first byte in the buffer
  std::uint64_t size_ = 0;      ///< of the file, without the buffer
  int error_ = 0;               ///< errno of the first failure
};

/// Throws Error(output): `target` cannot be written, with the text of `error_number` and what to do.
[[noreturn]] void fail_writing(const std::string& target, int error_number);

}  // namespace rpf::io
