// The fuzzer's bytes as a file, and what a command may say of a file that it refuses.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "must_hold.h"
#include "rpf/error.h"

/// A file in memory that has a path.
class MemoryFile {
 public:
  MemoryFile()
      : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {
    must_hold(descriptor_ >= 0, "memfd_create");
  }
  void fill(const std::uint8_t* data, std::size_t size) const {
    must_hold(::ftruncate(descriptor_, 0) == 0, "ftruncate");
    must_hold(::pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size), "pwrite");
  }
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

inline void expect_printable(const std::string& text) {
  for (const char letter : text)
    must_hold(static_cast<unsigned char>(letter) >= 0x20 && letter != 0x7f, "one printable line: " + text);
}

/// What `read` returns; nothing where it refuses the file as it should.
template <class Read>
auto attempt(const std::string& path, Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const rpf::Error& error) {
    const std::string text = error.what();
    must_hold(error.kind() == rpf::ErrorKind::input || error.kind() == rpf::ErrorKind::memory, "kind of: " + text);
    must_hold(text.find(path) != std::string::npos, "names the file: " + text);
    expect_printable(text);
    return std::nullopt;
  }
}
