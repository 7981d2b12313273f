#include "opencl/band.h"

#include <algorithm>

namespace rpf {
namespace {

std::size_t pixel_number(const Frame& frame, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width);
}

std::uint64_t record_bytes(const Frame& frame, std::uint64_t samples) {
  return samples * frame.variables * sizeof(float);
}

std::uint64_t color_bytes(std::uint64_t samples, const SampleFloats& floats) {
  return samples * floats.carried * sizeof(float);
}

std::uint64_t chunk_bytes(std::uint64_t samples, const SampleFloats& floats) {
  return samples * floats.chunks * sizeof(float);
}

std::uint64_t sample_count(const Frame& frame, const Rows& rows) {
  return frame.first_sample[pixel_number(frame, rows.end)] - frame.first_sample[pixel_number(frame, rows.begin)];
}

}  // namespace

SampleFloats::SampleFloats(const Plan& plan) : chunks(plan.variables.count() + plan.carried), carried(plan.carried) {
  if (plan.method == Method::rpf) chunks = (chunks + RPF_LANES - 1) / RPF_LANES * RPF_LANES;
}

std::uint64_t band_bytes(const Frame& frame, const SampleFloats& floats, const Rows& rows) {
  const std::size_t pixels = pixel_number(frame, rows.end) - pixel_number(frame, rows.begin);
  const std::uint64_t per_pixel = (pixels + 1) * sizeof(std::uint32_t) + pixels * sizeof(kernel::rpf_pixel_statistics);
  const std::uint64_t samples = sample_count(frame, rows);
  return record_bytes(frame, samples) + chunk_bytes(samples, floats) + 2 * color_bytes(samples, floats) + per_pixel;
}

bool fits(const Frame& frame, const SampleFloats& floats, const Rows& rows, const BandLimit& limit) {
  const std::uint64_t samples = sample_count(frame, rows);
  return band_bytes(frame, floats, rows) <= limit.total &&
         std::max({record_bytes(frame, samples), chunk_bytes(samples, floats), color_bytes(samples, floats)}) <=
             limit.buffer;
}

Rows rows_that_fit(const Frame& frame, const SampleFloats& floats, const Rows& needed, const BandLimit& limit) {
  if (fits(frame, floats, {0, frame.height}, limit)) return {0, frame.height};
  int fitting = needed.end, too_many = frame.height + 1;
  while (too_many - fitting > 1) {
    const int middle = fitting + (too_many - fitting) / 2;
    (fits(frame, floats, {needed.begin, middle}, limit) ? fitting : too_many) = middle;
  }
  return {needed.begin, fitting};
}

Band make_band(Session& session, const BandSource& source, int pass, const Rows& rows) {
  const Frame& frame = source.frame;
  const std::size_t begin = pixel_number(frame, rows.begin), end = pixel_number(frame, rows.end);
  const std::size_t first = frame.first_sample[begin], samples = sample_count(frame, rows);
  const std::size_t colors = color_bytes(samples, source.floats);
  Band band;
  band.pass = pass;
  band.rows = rows;
  band.first_pixel = static_cast<std::uint32_t>(begin);
  band.first_sample = static_cast<std::uint32_t>(first);
  band.samples = static_cast<std::uint32_t>(samples);
  band.first_samples = session.host_buffer(frame.first_sample.data() + begin, (end - begin + 1) * sizeof(std::uint32_t),
                                           CL_MEM_READ_ONLY);
  band.records = session.host_buffer(frame.record(first), record_bytes(frame, samples), CL_MEM_READ_ONLY);
  // A vector more: box.cl reads whole ones, the last from the last sample on.
  band.chunks = session.buffer(chunk_bytes(samples, source.floats) + RPF_LANES * sizeof(float));
  band.colors = session.host_buffer(source.colors.data() + first * source.floats.carried, colors, CL_MEM_READ_ONLY);
  band.next_colors =
      session.host_buffer(source.next_colors.data() + first * source.floats.carried, colors, CL_MEM_READ_WRITE);
  band.statistics = session.host_buffer(source.statistics.data() + begin,
                                        (end - begin) * sizeof(kernel::rpf_pixel_statistics), CL_MEM_READ_WRITE);
  return band;
}

}  // namespace rpf
