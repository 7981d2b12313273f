#include "test_frames.h"

#include <cstdlib>

namespace rpf::test {
namespace {

std::vector<std::uint32_t> offsets_of(const FrameOptions& o) {
  Dice dice(o.seed + 77);
  std::vector<std::uint32_t> first = {0};
  for (int p = 0; p < o.width * o.height; ++p)
    first.push_back(first.back() +
                    (o.samples > 0 ? static_cast<std::uint32_t>(o.samples) : static_cast<std::uint32_t>(dice() * 6)));
  return first;
}

/// One sample as a record in the order of the layout.
std::vector<float> shade(int x, int y, const FrameOptions& o, Dice& dice) {
  const float film_x = static_cast<float>(x) + dice(), film_y = static_cast<float>(y) + dice();
  const float lens_u = dice(), lens_v = dice(), time = dice();
  const bool near_surface = film_x + 6 * (lens_u - 0.5F) < static_cast<float>(o.width) / 2;
  const float texture = (static_cast<int>(film_x / 2) + static_cast<int>(film_y / 2)) % 2 == 0 ? 0.75F : 0.25F;
  const float light = 0.5F + dice() * (0.5F + time);
  const float albedo = near_surface ? texture : 0.5F;
  const float depth = near_surface ? 2.0F : 7.0F;
  return {albedo * light,
          0.5F * light,
          near_surface ? 0.125F : light * texture,
          film_x,
          film_y,
          lens_u,
          lens_v,
          time,
          near_surface ? 1.0F : 0.0F,
          0.0F,
          near_surface ? 0.0F : 1.0F,
          film_x * depth / 8,
          film_y * depth / 8,
          depth + texture / 4,
          albedo};
}

std::size_t column(const SampleBuffer& samples, const std::string& slot) { return *samples.layout.find(slot); }

}  // namespace

SampleBuffer defocused_edge(const FrameOptions& options) {
  SampleBuffer samples;
  samples.data_window = samples.display_window = {0, 0, options.width, options.height};
  samples.layout.slots = {"R",
                          "G",
                          "B",
                          "film.X",
                          "film.Y",
                          "random.lens.U",
                          "random.lens.V",
                          "random.time",
                          "feature.N.X",
                          "feature.N.Y",
                          "feature.N.Z",
                          "feature.P.X",
                          "feature.P.Y",
                          "feature.P.Z",
                          "feature.albedo.R"};
  samples.first_sample = offsets_of(options);
  Dice dice(options.seed);
  for (int p = 0; p < options.width * options.height; ++p)
    for (std::uint32_t i = samples.first_sample[p]; i < samples.first_sample[p + 1]; ++i)
      for (const float value : shade(p % options.width, p / options.width, options, dice))
        samples.values.push_back(value);
  return samples;
}

SampleBuffer every_input(const FrameOptions& options) {
  SampleBuffer samples = defocused_edge(options);
  const std::vector<std::string> more = {"random.light.U",   "random.light.V",   "random.bsdf.U", "random.bsdf.V",
                                         "feature.albedo.G", "feature.albedo.B", "feature.N2.X",  "feature.N2.Y",
                                         "feature.N2.Z",     "feature.P2.X",     "feature.P2.Y",  "feature.P2.Z"};
  for (const std::string& slot : more) add_channel(samples, slot, 0);
  add_channel(samples, "feature.hit", 1);
  Dice dice(options.seed + 1000);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    const bool hits = dice() < 0.9F, hits_again = hits && dice() < 0.7F;
    for (const std::string& slot : more) {
      const bool is_second = slot.find("2.") != std::string::npos;
      value_of(samples, i, slot) = is_second && !hits_again ? 0.0F : dice();
    }
    if (hits) continue;
    for (const char* slot :
         {"feature.N.X", "feature.N.Y", "feature.N.Z", "feature.P.X", "feature.P.Y", "feature.P.Z", "feature.hit"})
      value_of(samples, i, slot) = 0;
  }
  return samples;
}

std::string backend_under_test() {
  const char* name = std::getenv("RPF_TEST_BACKEND");
  return name == nullptr ? "cpu" : name;
}

Settings small_settings() {
  Settings settings;
  settings.backend = backend_under_test();
  settings.box_widths = {9, 5, 3};
  settings.threads = 1;
  return settings;
}

SampleBuffer with_slots(const SampleBuffer& samples, const std::vector<std::string>& slots) {
  SampleBuffer some = samples;
  some.layout.slots = slots;
  some.values.clear();
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const std::string& slot : slots) some.values.push_back(samples.record(i)[column(samples, slot)]);
  return some;
}

float& value_of(SampleBuffer& samples, std::size_t sample, const std::string& slot) {
  return samples.record(sample)[column(samples, slot)];
}

void fill(SampleBuffer& samples, const std::string& slot, float value) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i) value_of(samples, i, slot) = value;
}

void scale_radiance(SampleBuffer& samples, float factor) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) *= factor;
}

void add_channel(SampleBuffer& samples, const std::string& slot, float value) {
  SampleBuffer wider = samples;
  wider.layout.slots.push_back(slot);
  wider.values.clear();
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    wider.values.insert(wider.values.end(), samples.record(i), samples.record(i) + samples.layout.size());
    wider.values.push_back(value);
  }
  samples = wider;
}

void cast_shadows(SampleBuffer& samples) {
  Dice dice(77);
  for (const char* slot : {"feature.penumbra.slope", "feature.penumbra.width"}) add_channel(samples, slot, 0);
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    if (dice() < 0.7F) continue;
    const float slope = 0.1F + dice();
    value_of(samples, i, "feature.penumbra.slope") = slope;
    value_of(samples, i, "feature.penumbra.width") = 2 * slope;
  }
}

std::vector<float> part_of(const Image& image, const Window& part) {
  std::vector<float> pixels;
  for (int y = 0; y < part.height; ++y) {
    const int row = (part.y - image.data_window.y + y) * image.data_window.width;
    const float* first = image.pixel(static_cast<std::size_t>(row + part.x - image.data_window.x));
    pixels.insert(pixels.end(), first, first + static_cast<std::size_t>(part.width) * image.channel_count());
  }
  return pixels;
}

}  // namespace rpf::test
