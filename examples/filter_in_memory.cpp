// Filters samples that are in memory, and stops where it takes too long: filter_in_memory OUTPUT.exr [SECONDS]
#include <cstdlib>
#include <iostream>
#include <random>

#include "rpf/rpf.h"

namespace {

constexpr int width = 96, height = 64, samples_per_pixel = 4;

/// The place of a renderer: a blurred edge, seen through a lens. Writes each record where the filter will work on it.
rpf::SampleBuffer render() {
  rpf::SampleBuffer buffer;
  buffer.data_window = buffer.display_window = {0, 0, width, height};
  buffer.layout.slots = {"R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V"};
  for (std::uint32_t pixel = 0; pixel <= width * height; ++pixel)
    buffer.first_sample.push_back(pixel * samples_per_pixel);
  const std::size_t slots = buffer.layout.size();
  buffer.values.reserve(buffer.sample_count() * (slots + rpf::spare_columns));  // room that the filter would else take
  buffer.values.resize(buffer.sample_count() * slots);
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> draw;
  for (std::size_t sample = 0; sample < buffer.sample_count(); ++sample) {
    const std::size_t pixel = sample / samples_per_pixel;
    float* record = buffer.record(sample);
    record[3] = static_cast<float>(pixel % width) + draw(engine);
    record[4] = static_cast<float>(pixel / width) + draw(engine);
    record[5] = draw(engine), record[6] = draw(engine);
    const float light = record[3] + 24 * (record[5] - 0.5F) > width / 2 ? 0.9F : 0.1F;
    record[0] = record[1] = record[2] = light;
  }
  return buffer;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) return 2;
  const double limit = argc > 2 ? std::atof(argv[2]) : 60;
  rpf::Settings settings = rpf::preset_settings("balanced");
  settings.backend = "auto";
  rpf::Control control;
  control.progress = [limit](const rpf::Progress& p) {
    std::cerr << static_cast<int>(100 * p.fraction) << " %\n";
    return p.seconds < limit;  // false: filter() throws Error(cancelled)
  };
  const rpf::Result result = rpf::filter(render(), settings, control);
  rpf::write_image(argv[1], result.image);
  return 0;
} catch (const rpf::Error& e) {
  std::cerr << e.what() << '\n';
  return static_cast<int>(e.kind());
}
