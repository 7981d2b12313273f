#include "io/reading.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/channel_names.h"
#include "rpf/error.h"

namespace rpf::io {

void check_budget(const std::string& path, std::uint64_t need, std::uint64_t limit) {
  constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
  if (limit == 0 || need <= limit) return;
  throw Error(
      ErrorKind::memory,
      fmt::format("\"{}\" needs {} MB of memory to read, but the limit is {} MB; raise --max-memory or crop the "
                  "file",
                  path, (need + megabyte - 1) / megabyte, limit / megabyte));
}

void check_sample_count(const std::string& path, std::uint64_t samples) {
  if (samples > most_samples_of_frame)
    throw Error(ErrorKind::input,
                fmt::format("\"{}\" holds {} samples, more than the {} that one buffer takes; crop or "
                            "split the frame",
                            path, samples, most_samples_of_frame));
}

void check_read_back(const std::string& path, const SampleFileInfo& back, const Window& window, std::uint64_t samples) {
  if (back.sample_count != samples || !(back.data_window == window))
    throw Error(ErrorKind::output, fmt::format("\"{}\" was not written correctly: {} of {} samples came back; check "
                                               "the disk and write it again",
                                               path, back.sample_count, samples));
}

void leave_out_unwanted(SampleFileInfo& info, const SampleReadOptions& options) {
  if (!options.slots) return;
  for (SampleFileChannel& channel : info.channels)
    if (std::find(options.slots->begin(), options.slots->end(), channel.slot) == options.slots->end())
      channel.slot.clear();
}

void allocate_values(SampleBuffer& samples) {
  samples.values.reserve(samples.sample_count() * (samples.layout.size() + spare_columns));
  samples.values.resize(samples.sample_count() * samples.layout.size());
}

SampleBuffer empty_buffer(const SampleFileInfo& info) {
  SampleBuffer samples;
  samples.data_window = info.data_window;
  samples.display_window = info.display_window;
  samples.metadata = info.metadata;
  for (const SampleFileChannel& channel : info.channels)
    if (channel.type == PixelType::half_float && !channel.slot.empty()) samples.half_slots.push_back(channel.slot);
  std::vector<std::string> slots;
  slots.reserve(info.channels.size());
  for (const SampleFileChannel& channel : info.channels) slots.push_back(channel.slot);
  samples.layout = record_layout(slots);
  return samples;
}

SampleBuffer empty_rows(const SampleBuffer& frame, int first, int end) {
  SampleBuffer samples = frame;
  samples.data_window.y += first;
  samples.data_window.height = end - first;
  samples.first_sample.reserve(samples.data_window.pixel_count() + 1);
  samples.first_sample.push_back(0);
  return samples;
}

}  // namespace rpf::io
