#include "cli/needs.h"

#include "rpf/filter.h"

namespace rpf::cli {

SampleLayout needed_layout(const SampleFileInfo& info, const Settings& settings) {
  SampleLayout all;
  for (const SampleFileChannel& channel : info.channels)
    if (!channel.slot.empty()) all.slots.push_back(channel.slot);
  return {needed_slots(all, settings)};
}

std::uint64_t predicted_memory(const SampleFileInfo& info, const Settings& settings) {
  const FrameSize size{info.data_window.pixel_count(), info.sample_count, info.max_samples, info.data_window.width};
  return predict_memory(size, needed_layout(info, settings), settings);
}

}  // namespace rpf::cli
