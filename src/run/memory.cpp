#include "run/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "frame/selection.h"
#include "learned/network_file.h"
#include "parallel/thread_count.h"
#include "plan/sample_tree.h"
#include "plan/view_cells.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/methods.h"
#include "run/backends.h"
#include "run/error_estimate.h"
#include "run/estimate_bands.h"
#include "run/streamed_frame.h"
#include "seam/backend.h"

namespace rpf {
namespace {

constexpr std::uint64_t word = 4;

/// Most floats a sample that exist at once: while records are made of what was read, in place where there is room for
/// them, beside the first colors; or while filtering, with the colors of this and the next pass.
std::uint64_t sample_floats(std::uint64_t read, std::uint64_t room, std::uint64_t records, std::uint64_t carried) {
  const std::uint64_t preparing = records <= room ? std::max(read, records) : read + records;
  return std::max(preparing + carried, records + 2 * carried);
}

std::uint64_t pixel_method_need(const FrameSize& size, const SampleLayout& layout, std::uint64_t room, FrameFacts facts,
                                const Settings& settings) {
  facts.width = std::max(size.width, 1);
  facts.height = static_cast<int>(size.pixels / static_cast<std::uint64_t>(facts.width));
  const PixelPlan plan = make_pixel_plan(facts, settings);
  const std::uint64_t floats = sample_floats(layout.size(), room, facts.variables.count(), facts.carried);
  return size.samples * word * floats + size.pixels * (pixel_bytes(facts.carried) + word * plan.planes) +
         make_backend(settings)->step_bytes(plan);
}

/// Tracks, ends and colors of samples, their places by number and by cell; means and sums of pixels; cells, twice.
std::uint64_t light_field_need(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                               const FrameFacts& facts) {
  const int width = std::max(size.width, 1), height = static_cast<int>(size.pixels / static_cast<unsigned>(width));
  const std::uint64_t floats = sample_floats(layout.size(), room, facts.variables.count(), facts.carried);
  const std::uint64_t of_views = RPF_TRACK + RPF_ENDS + 2 * RPF_PLACE + 2 + facts.carried;
  return size.samples * word * (floats + of_views) +
         size.pixels * (pixel_bytes(facts.carried) + word * (2 * facts.carried + 1)) +
         2 * word * cells_of(light_field_shape(width, std::max(height, 1), facts.carried, size.samples));
}

/// Places, numbers and leaves of samples, their colors; means and sums of pixels; metrics and tensors of leaves.
std::uint64_t columns_need(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                           const FrameFacts& facts) {
  constexpr std::uint64_t of_leaf = RPF_METRIC + 2 * RPF_DIMENSIONS * RPF_DIMENSIONS + 3;
  const std::uint64_t floats = sample_floats(layout.size(), room, facts.variables.count(), facts.carried);
  return size.samples * word * (floats + 2 * RPF_DIMENSIONS + 2 + facts.carried) +
         leaves_for(size.samples) * word * of_leaf +
         size.pixels * (pixel_bytes(facts.carried) + word * (2 * facts.carried + 1));
}

/// `room`: columns that the buffer of values can hold.
std::uint64_t memory_need(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                          const Settings& settings) {
  if (settings.method == Method::learned)
    return estimate_bands(size, layout, room, settings, *make_backend(settings)).bytes;
  const FrameFacts facts = largest_facts(size, layout, settings);
  if (settings.method == Method::lightfield) return light_field_need(size, layout, room, facts);
  if (settings.method == Method::multidim) return columns_need(size, layout, room, facts);
  if (filters_pixels(settings.method)) return pixel_method_need(size, layout, room, facts, settings);
  Settings without_crop = settings;
  without_crop.crop.reset();
  const Plan plan = make_plan(facts, without_crop);
  const std::uint64_t floats = sample_floats(layout.size(), room, facts.variables.count(), facts.carried);
  return size.samples * word * floats + size.pixels * pixel_bytes(facts.carried) +
         make_backend(settings)->scratch_bytes(plan, size.samples);
}

/// The largest number of samples in one pixel.
std::uint32_t most_samples(const std::vector<std::uint32_t>& first_sample) {
  std::uint32_t most = 0;
  for (std::size_t p = 0; p + 1 < first_sample.size(); ++p)
    most = std::max(most, first_sample[p + 1] - first_sample[p]);
  return most;
}

}  // namespace

std::uint64_t pixel_bytes(std::uint64_t carried) { return 2 * word + sizeof(PixelStatistics) + 3 * word * carried; }

FrameFacts largest_facts(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  FrameFacts facts;
  facts.width = size.width;
  facts.height = std::numeric_limits<int>::max();  // what the box is, the frame has room for
  facts.max_samples_per_pixel = size.max_samples_per_pixel;
  const Selection selection = select_channels(layout, settings);
  facts.variables.random_names = selection.random;
  facts.variables.feature_names = selection.features;
  facts.carried = carried_count(layout, settings);
  return facts;
}

FrameSize frame_size(const SampleBuffer& samples) {
  return {samples.data_window.pixel_count(), samples.sample_count(), most_samples(samples.first_sample),
          samples.data_window.width};
}

RawSize streamed_size(const SampleRows& rows, std::uint32_t most_samples) {
  const SampleBuffer& frame = rows.frame();
  const std::uint64_t room = frame.layout.size() + spare_columns;
  const std::uint64_t samples = StreamedFrame::least_bytes(rows) / (room * sizeof(float));
  return {{frame.data_window.pixel_count(), samples, most_samples, frame.data_window.width}, frame.layout, room};
}

std::uint64_t room_of(const SampleBuffer& samples) {
  return samples.values.capacity() / std::max<std::uint64_t>(samples.sample_count(), 1);
}

std::size_t carried_count(const SampleLayout& layout, const Settings& settings) {
  const std::size_t colors = layout.find("A") ? 4 : 3;
  if (!settings.filter_features) return colors;
  const auto is_feature = [](const std::string& slot) { return is_feature_slot(slot); };
  return colors + static_cast<std::size_t>(std::count_if(layout.slots.begin(), layout.slots.end(), is_feature));
}

std::uint64_t predict_memory(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  if (settings.estimate_error) check_halves(size, settings.method);
  if (settings.method == Method::learned) find_network(settings.model, settings.max_memory);  // whether it fits
  const std::uint64_t halves = settings.estimate_error
                                   ? size.samples * (layout.size() + spare_columns) * word  // one, and its plain mean's
                                   : 0;
  return memory_need(size, layout, layout.size() + spare_columns, settings) + halves;
}

void check_memory(const SampleBuffer& samples, const Settings& settings, std::uint64_t more) {
  if (settings.max_memory == 0) return;
  const std::uint64_t need = memory_need(frame_size(samples), samples.layout, room_of(samples), settings) + more;
  constexpr double megabyte = 1 << 20;
  if (need > settings.max_memory)
    throw Error(ErrorKind::memory,
                fmt::format("filtering needs {:.0f} MB, the limit is {:.0f} MB; raise --max-memory, lower --threads or "
                            "leave channels out",
                            static_cast<double>(need) / megabyte, static_cast<double>(settings.max_memory) / megabyte));
}

}  // namespace rpf
