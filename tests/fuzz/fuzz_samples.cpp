// Whatever bytes a sample file has: it is read whole, or refused with one printable line that names it, within the
// memory limit. Run with -malloc_limit_mb, so that an allocation beyond the limit stops the run.
#include <cstdint>

#include "memory_file.h"
#include "must_hold.h"
#include "rpf/io.h"

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
