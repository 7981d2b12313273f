#include <limits>
#include <memory>

#include "c_api/objects.h"
#include "rpf/filter.h"
#include "rpf/io.h"

using rpf::c_api::guarded;
using rpf::c_api::require;

namespace {

std::vector<std::uint32_t> offsets_of(const rpf::Window& window, const std::uint32_t* samples_of_pixel) {
  std::vector<std::uint32_t> first = {0};
  first.reserve(window.pixel_count() + 1);
  std::uint64_t samples = 0;
  for (std::size_t pixel = 0; pixel < window.pixel_count(); ++pixel) {
    samples += samples_of_pixel[pixel];
    if (samples > rpf::most_samples_of_frame)
      throw rpf::Error(rpf::ErrorKind::usage,
                       "rpf_sample_buffer_new: a frame can have 4294967294 samples; hand it over in parts");
    first.push_back(static_cast<std::uint32_t>(samples));
  }
  return first;
}

/// All values missing, with the room behind them that filtering takes.
rpf::SampleBuffer empty_buffer(const rpf::Window& window, const char* const* slots, std::size_t slot_count,
                               const std::uint32_t* samples_of_pixel) {
  rpf::SampleBuffer buffer;
  buffer.data_window = buffer.display_window = window;
  buffer.layout.slots.assign(slots, slots + slot_count);
  buffer.first_sample = offsets_of(window, samples_of_pixel);
  buffer.values.reserve(buffer.sample_count() * (slot_count + rpf::spare_columns));
  buffer.values.resize(buffer.sample_count() * slot_count, std::numeric_limits<float>::quiet_NaN());
  buffer.validate();
  return buffer;
}

rpf::SampleReadOptions options_for(const char* path, const rpf_settings* settings) {
  rpf::SampleReadOptions options;
  if (settings == nullptr) return options;
  options.max_memory = settings->value.max_memory;
  options.threads = settings->value.threads;
  rpf::SampleLayout layout;
  for (const rpf::SampleFileChannel& channel : rpf::inspect_samples(path, options).channels)
    if (!channel.slot.empty()) layout.slots.push_back(channel.slot);
  options.slots = rpf::needed_slots(layout, settings->value);
  return options;
}

}  // namespace

rpf_status rpf_sample_buffer_new(int x, int y, int width, int height, const char* const* slots, size_t slot_count,
                                 const uint32_t* samples_of_pixel, rpf_sample_buffer** buffer) {
  return guarded([&] {
    require(buffer, "rpf_sample_buffer_new: buffer");
    *buffer = nullptr;
    require(slots, "rpf_sample_buffer_new: slots");
    require(samples_of_pixel, "rpf_sample_buffer_new: samples_of_pixel");
    if (width < 1 || height < 1)
      throw rpf::Error(rpf::ErrorKind::usage, "rpf_sample_buffer_new: a width and a height of 1 or more are expected");
    *buffer = new rpf_sample_buffer{empty_buffer({x, y, width, height}, slots, slot_count, samples_of_pixel)};
  });
}

rpf_status rpf_sample_buffer_read(const char* path, const rpf_settings* settings, rpf_sample_buffer** buffer) {
  return guarded([&] {
    require(buffer, "rpf_sample_buffer_read: buffer");
    *buffer = nullptr;
    require(path, "rpf_sample_buffer_read: path");
    *buffer = new rpf_sample_buffer{rpf::read_samples(path, options_for(path, settings))};
  });
}

rpf_status rpf_sample_buffer_write(const char* path, const rpf_sample_buffer* buffer) {
  return guarded([&] {
    require(path, "rpf_sample_buffer_write: path");
    require(buffer, "rpf_sample_buffer_write: buffer");
    rpf::write_samples(path, buffer->value, buffer->value.half_slots);
  });
}

float* rpf_sample_buffer_values(rpf_sample_buffer* buffer) { return buffer->value.values.data(); }

size_t rpf_sample_buffer_sample_count(const rpf_sample_buffer* buffer) { return buffer->value.sample_count(); }

size_t rpf_sample_buffer_slot_count(const rpf_sample_buffer* buffer) { return buffer->value.layout.size(); }

void rpf_sample_buffer_free(rpf_sample_buffer* buffer) { delete buffer; }
