#include "memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "backend.h"
#include "frame.h"
#include "polish.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "spikes.h"

namespace rpf {
namespace {

constexpr std::uint64_t word = 4;

/// Bytes while filtering: records, colors of this and the next pass, and per pixel: offsets, statistics, two images.
std::uint64_t filtering_bytes(const FrameSize& size, std::uint64_t record_floats, std::uint64_t carried) {
  const std::uint64_t per_sample = word * (record_floats + 2 * carried);
  const std::uint64_t per_pixel = 2 * word + sizeof(PixelStatistics) + 3 * word * carried;
  return size.samples * per_sample + size.pixels * per_pixel;
}

FrameFacts facts_of(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  FrameFacts facts;
  facts.max_samples_per_pixel = size.max_samples_per_pixel;
  const Selection selection = select_channels(layout, settings);
  facts.variables.random_names = selection.random;
  facts.variables.feature_names = selection.features;
  facts.carried = layout.find("A") ? 4 : 3;
  const auto is_feature = [](const std::string& slot) { return is_feature_slot(slot); };
  if (settings.filter_features)
    facts.carried += static_cast<std::size_t>(std::count_if(layout.slots.begin(), layout.slots.end(), is_feature));
  return facts;
}

}  // namespace

std::uint64_t predict_memory(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  const FrameFacts facts = facts_of(size, layout, settings);
  Settings without_crop = settings;
  without_crop.crop.reset();
  const Plan plan = make_plan(facts, without_crop);
  // The buffer that was read becomes the records, unless these are longer; then both exist for a moment.
  const std::uint64_t read = layout.size(), records = facts.variables.count();
  const std::uint64_t floats = records <= read ? read : read + records;
  const std::uint64_t steps =
      (plan.spread_spikes ? spikes_bytes(size.pixels) : 0) + polish_bytes(plan, thread_count(settings));
  return filtering_bytes(size, floats, facts.carried) + steps +
         make_backend(settings)->scratch_bytes(plan, size.samples);
}

void check_memory(const SampleBuffer& samples, const Settings& settings) {
  if (settings.max_memory == 0) return;
  const FrameSize size{samples.data_window.pixel_count(), samples.sample_count(), most_samples(samples.first_sample)};
  const std::uint64_t need = predict_memory(size, samples.layout, settings);
  constexpr double megabyte = 1 << 20;
  if (need > settings.max_memory)
    throw Error(ErrorKind::memory,
                fmt::format("filtering needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory, lower --threads or "
                            "leave channels out",
                            static_cast<double>(need) / megabyte, static_cast<double>(settings.max_memory) / megabyte));
}

}  // namespace rpf
