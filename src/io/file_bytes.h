// Read-only access to the bytes of an input file; every read is checked against the file's end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace rpf::io {

class FileBytes {
 public:
  /// Throws Error(input) where `path` is missing, not readable or not a regular file.
  explicit FileBytes(const std::string& path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// Copies `count` bytes from `offset`. Throws Error(input) where the file ends before; `what` says what was read.
  void read(std::uint64_t offset, void* target, std::size_t count, const char* what);
  std::uint8_t byte(std::uint64_t offset, const char* what);
  /// Little-endian integers, as OpenEXR stores them.
  std::uint32_t u32(std::uint64_t offset, const char* what);
  std::uint64_t u64(std::uint64_t offset, const char* what);

 private:
  /// Copies up to `count` bytes and returns how many; 0 at the end of the file.
  std::size_t read_some(std::uint64_t offset, void* target, std::size_t count) const;
  std::size_t read_through_block(std::uint64_t offset, void* target, std::size_t count);

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::array<std::uint8_t, 4096> block_{};  // the part of the file around the last read
  std::uint64_t block_begin_ = 0;
  std::size_t block_size_ = 0;
};

}  // namespace rpf::io
