#include "explain/pixel_number.h"

#include <fmt/format.h>

#include "rpf/error.h"

namespace rpf {

std::uint32_t pixel_number(const PixelPosition& pixel, const SampleBuffer& samples) {
  const Window& w = samples.data_window;
  const std::int64_t x = std::int64_t{pixel.x} - w.x, y = std::int64_t{pixel.y} - w.y;
  if (x < 0 || y < 0 || x >= w.width || y >= w.height)
    throw Error(ErrorKind::usage,
                fmt::format("--pixel {},{} is not inside the data window {}", pixel.x, pixel.y, text_of(w)));
  const auto number = static_cast<std::uint32_t>(y * w.width + x);
  check_has_samples(pixel, number, samples.first_sample);
  return number;
}

void check_has_samples(const PixelPosition& pixel, std::uint32_t number,
                       const std::vector<std::uint32_t>& first_sample) {
  if (first_sample[number] == first_sample[number + 1])
    throw Error(ErrorKind::input, fmt::format("pixel {},{} has no samples; choose another", pixel.x, pixel.y));
}

}  // namespace rpf
