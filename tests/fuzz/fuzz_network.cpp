// Whatever bytes a network file has (--model FILE): it filters to finite pixels, or is refused with one printable line
// that names it. On the reference, for every shape would compile kernels of its own.
#include <cmath>
#include <cstdint>

#include "memory_file.h"
#include "must_hold.h"
#include "rpf/filter.h"

namespace {

constexpr int width = 5, height = 3, samples_per_pixel = 2;

/// Every kind of channel that a network looks at, with values that vary.
rpf::SampleBuffer small_frame() {
  rpf::SampleBuffer samples;
  samples.data_window = samples.display_window = {0, 0, width, height};
  samples.layout.slots = {"R",
                          "G",
                          "B",
                          "film.X",
                          "film.Y",
                          "random.lens.U",
                          "random.lens.V",
                          "feature.N.X",
                          "feature.N.Y",
                          "feature.N.Z",
                          "feature.P.X",
                          "feature.P.Y",
                          "feature.P.Z",
                          "feature.hit",
                          "feature.albedo.R",
                          "feature.albedo.G",
                          "feature.albedo.B"};
  samples.first_sample.push_back(0);
  for (int pixel = 0; pixel < width * height; ++pixel) {
    for (int i = 0; i < samples_per_pixel; ++i)
      for (std::size_t column = 0; column < samples.layout.size(); ++column) {
        float value = static_cast<float>((samples.values.size() * 37 + column) % 101) / 101.0F;
        if (column == 3) value += static_cast<float>(pixel % width);
        if (column == 4) value += static_cast<float>(pixel / width);
        samples.values.push_back(value);
      }
    samples.first_sample.push_back(samples.first_sample.back() + samples_per_pixel);
  }
  return samples;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  file.fill(data, size);
  rpf::Settings settings;
  settings.backend = "cpu";
  settings.threads = 1;
  settings.method = rpf::Method::learned;
  settings.model = file.path();
  const auto result = attempt(file.path(), [&] { return rpf::filter(small_frame(), settings); });
  if (!result) return 0;
  expect_printable(result->report.model);
  for (const float value : result->image.pixels) must_hold(std::isfinite(value), "finite pixels");
  return 0;
}
