#include "opencl/band.h"

#include <algorithm>

namespace rpf {
namespace {

std::size_t pixel_number(const Frame& frame, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width);
}

std::uint64_t record_bytes(const Frame& frame, std::uint64_t samples) {
  return (samples * frame.variables + RPF_LANES) * sizeof(float);  // vector loads may reach behind the last record
}

}  // namespace

bool fits(const Frame& frame, std::size_t carried, const Rows& rows, const BandLimit& limit) {
  const std::size_t begin = pixel_number(frame, rows.begin), end = pixel_number(frame, rows.end);
  const std::uint64_t pixels = end - begin, samples = frame.first_sample[end] - frame.first_sample[begin];
  const std::uint64_t records = record_bytes(frame, samples), colors = samples * carried * sizeof(float);
  const std::uint64_t per_pixel = (pixels + 1) * sizeof(std::uint32_t) + pixels * sizeof(kernel::rpf_pixel_statistics);
  return records + 2 * colors + per_pixel <= limit.total && std::max(records, colors) <= limit.buffer;
}

Rows rows_that_fit(const Frame& frame, std::size_t carried, const Rows& needed, const BandLimit& limit) {
  if (fits(frame, carried, {0, frame.height}, limit)) return {0, frame.height};
  int fitting = needed.end, too_many = frame.height + 1;
  while (too_many - fitting > 1) {
    const int middle = fitting + (too_many - fitting) / 2;
    (fits(frame, carried, {needed.begin, middle}, limit) ? fitting : too_many) = middle;
  }
  return {needed.begin, fitting};
}

Band make_band(Session& session, const BandSource& source, int pass, const Rows& rows) {
  const Frame& frame = source.frame;
  const std::size_t begin = pixel_number(frame, rows.begin), end = pixel_number(frame, rows.end);
  const std::size_t first = frame.first_sample[begin], samples = frame.first_sample[end] - first;
  const std::size_t color_bytes = samples * source.carried * sizeof(float);
  Band band;
  band.pass = pass;
  band.rows = rows;
  band.first_pixel = static_cast<std::uint32_t>(begin);
  band.first_sample = static_cast<std::uint32_t>(first);
  band.first_samples = session.host_buffer(frame.first_sample.data() + begin, (end - begin + 1) * sizeof(std::uint32_t),
                                           CL_MEM_READ_ONLY);
  band.records = session.host_buffer(frame.record(first), record_bytes(frame, samples), CL_MEM_READ_ONLY);
  band.colors = session.host_buffer(source.colors.data() + first * source.carried, color_bytes, CL_MEM_READ_ONLY);
  band.next_colors =
      session.host_buffer(source.next_colors.data() + first * source.carried, color_bytes, CL_MEM_READ_WRITE);
  band.statistics = session.host_buffer(source.statistics.data() + begin,
                                        (end - begin) * sizeof(kernel::rpf_pixel_statistics), CL_MEM_READ_WRITE);
  return band;
}

}  // namespace rpf
