// Whatever bytes a sample file has: it is read whole, or refused with one printable line that names it, within the
// memory limit. Run with -malloc_limit_mb, so that an allocation beyond the limit stops the run.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <optional>

#include "must_hold.h"
#include "rpf/error.h"
#include "rpf/io.h"

namespace {

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

/// What `read` returns; nothing where it refuses the file as it should.
template <class Read>
auto attempt(const std::string& path, Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const rpf::Error& error) {
    const std::string text = error.what();
    must_hold(error.kind() == rpf::ErrorKind::input || error.kind() == rpf::ErrorKind::memory, "kind of: " + text);
    must_hold(text.find(path) != std::string::npos, "names the file: " + text);
    for (const char letter : text)
      must_hold(static_cast<unsigned char>(letter) >= 0x20 && letter != 0x7f, "one printable line: " + text);
    return std::nullopt;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  file.fill(data, size);
  rpf::SampleReadOptions options;
  options.max_memory = std::uint64_t{64} << 20;
  const auto info = attempt(file.path(), [&] { return rpf::inspect_samples(file.path(), options); });
  const auto samples = attempt(file.path(), [&] { return rpf::read_samples(file.path(), options); });
  if (!samples) return 0;
  samples->validate();
  must_hold(info.has_value(), "a file that is read can be inspected");
  must_hold(info->sample_count == samples->sample_count(), "inspection counts the samples that are read");
  must_hold(info->data_window == samples->data_window, "inspection sees the window that is read");
  return 0;
}
