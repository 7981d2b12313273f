#include "run/estimate_bands.h"

#include <algorithm>

#include "frame/selection.h"
#include "learned/network_file.h"
#include "run/memory.h"
#include "run/plain_means.h"

namespace rpf {
namespace {

constexpr std::uint64_t word = sizeof(float);

/// What a plan can be at most for samples of such a layout.
EstimatePlan largest_plan(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  EstimatePlan plan;
  plan.network = find_network(settings.model);
  plan.width = std::max(size.width, 1);
  plan.height = static_cast<int>(size.pixels / static_cast<std::uint64_t>(plan.width));
  plan.carried = carried_count(layout, settings);
  plan.has_albedo = layout.find("feature.albedo.R").has_value();
  for (int input = 0; input < RPF_INPUTS; ++input) plan.live.push_back(input);
  return plan;
}

/// Frame and result, from reading on.
std::uint64_t bytes_of_frame(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                             const Settings& settings) {
  const Selection selection = select_channels(layout, settings);
  // Two inputs that a file has no channels for: whether there is a hit, and a second one.
  const std::uint64_t records = Variables::random + selection.random.size() + selection.features.size() +
                                (layout.find("feature.hit") ? 1 : 0) + 2;
  const std::uint64_t read = layout.size(), carried = carried_count(layout, settings);
  const std::uint64_t weights = layout.find("weight") ? 1 : 0;
  const std::uint64_t per_sample = (records <= room ? std::max(read, records) : read + records) + carried - 3 + weights;
  const std::uint64_t means = has_own_share(size.max_samples_per_pixel) ? carried + 2 : 0;  // mean and a double
  const std::uint64_t per_pixel = 1 + 3 * carried + means;  // offsets; band, frame, image
  return word * (size.samples * per_sample + size.pixels * per_pixel);
}

/// The pixels that a band of so many rows of the crop reads at most.
Window largest_window(const EstimatePlan& plan, const Window& crop, int rows) {
  const int more = 1 << (plan.network->levels() - 1);  // cells are aligned to the frame
  Window band = crop;
  band.height = std::min(rows + more, plan.height);
  band.y = (plan.height - band.height) / 2;
  return window_around(plan, band);
}

}  // namespace

EstimateBands estimate_bands(const FrameSize& size, const SampleLayout& layout, std::uint64_t room,
                             const Settings& settings, const Backend& backend) {
  const EstimatePlan plan = largest_plan(size, layout, settings);
  const std::uint64_t frame = bytes_of_frame(size, layout, room, settings);
  Window crop{0, 0, plan.width, plan.height};
  if (settings.crop)
    crop = {0, 0, std::min(settings.crop->width, plan.width), std::min(settings.crop->height, plan.height)};
  const auto need = [&](int rows) {
    const Window window = largest_window(plan, crop, rows);
    const std::uint64_t samples = std::min(size.samples, window.pixel_count() * size.max_samples_per_pixel);
    return frame + backend.estimate_bytes(plan, window, samples);
  };
  EstimateBands bands{std::max(crop.height, 1), 0};
  const auto is_too_much = [&] { return settings.max_memory > 0 && need(bands.rows) > settings.max_memory; };
  while (bands.rows > 1 && is_too_much()) bands.rows = (bands.rows + 1) / 2;
  bands.bytes = need(bands.rows);
  return bands;
}

}  // namespace rpf
