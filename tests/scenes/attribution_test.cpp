// Who makes the noise of `combined`: what explain() says against variances that are measured with many samples, and
// against frames in which only one group of random parameters is alive.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <functional>

#include "explain/attribution.h"
#include "frame/prepare.h"
#include "parallel/workers.h"
#include "rpf/explain.h"
#include "rpf/filter.h"
#include "scene/integrator.h"
#include "scene/random.h"
#include "scene/record.h"
#include "scene/registry.h"
#include "scene/renderer.h"
#include "scene/tracer.h"

namespace rpf {
namespace {

enum Group : std::size_t { lens, time, light };
constexpr std::array<const char*, 3> group_names = {"lens", "time", "light"};
constexpr int width = 480, height = 270;

/// Calls `body` for 0 .. count - 1 on all cores.
void for_all(std::size_t count, const std::function<void(std::size_t)>& body) {
  Workers(available_threads()).for_all(0, count, [&](std::size_t i, std::size_t /*worker*/) { body(i); });
}

/// `draw`, but for one group, which is `other`'s.
scene::Draw with_group_of(scene::Draw draw, const scene::Draw& other, std::size_t group) {
  if (group == lens) draw.lens = other.lens;
  if (group == time) draw.time = other.time;
  if (group == light) draw.light = other.light;
  return draw;
}

class Combined {
 public:
  Combined() : world_(scene::find_scene("combined").build()), tracer_(world_) {}

  scene::Path path(std::size_t pixel, const scene::Draw& draw) const {
    const scene::Ray ray =
        world_.camera.ray(scene::film_position(pixel % width, draw.film.u),
                          scene::film_position(pixel / width, draw.film.v), width, height, draw.lens, draw.time);
    return scene::trace_path(world_, tracer_, ray, draw);
  }
  scene::Usage usage() const { return world_.usage(); }

 private:
  scene::World world_;
  scene::Tracer tracer_;
};

double squared_distance(const scene::Vec3& a, const scene::Vec3& b) {
  const scene::Vec3 d = a - b;
  return static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y + static_cast<double>(d.z) * d.z;
}

/// Sobol's total indices, not divided by the variance: E (f(a) - f(a with the group of b))^2 / 2, with all else as it
/// was.
struct Truth {
  double variance = 0;
  std::array<double, 3> total{};

  /// Whether the group makes half of the pixel's noise or more, and the two others next to none of it.
  bool only(std::size_t group) const {
    const double all = total[lens] + total[time] + total[light];
    return variance > 1e-5 && total[group] > 0.5 * variance && all - total[group] < 0.05 * all;
  }
};

Truth measure(const Combined& combined, std::size_t pixel) {
  constexpr std::uint32_t samples = 128;
  const auto number = static_cast<std::uint32_t>(pixel);
  const scene::PixelSampler first(SceneSampler::random, scene::hash(11, number), samples);
  const scene::PixelSampler second(SceneSampler::random, scene::hash(12, number), samples);
  Truth truth;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const scene::Draw a = first.draw(i), b = second.draw(i);
    const scene::Vec3 color = combined.path(pixel, a).radiance;
    truth.variance += squared_distance(color, combined.path(pixel, b).radiance) / 2 / samples;
    for (std::size_t g = 0; g < 3; ++g)
      truth.total[g] += squared_distance(color, combined.path(pixel, with_group_of(a, b, g)).radiance) / 2 / samples;
  }
  return truth;
}

/// Shares of a group at some pixels.
struct Shares {
  std::vector<float> values;

  double median() {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  }
  double part_from(float least) const {
    const auto count = std::count_if(values.begin(), values.end(), [&](float share) { return share >= least; });
    return static_cast<double>(count) / static_cast<double>(values.size());
  }
  /// The numbers of docs/explain.md.
  void tell(const std::string& what) {
    fmt::print("{}: {} pixels, median share {:.3f}, {:.1f} % of them at 0.8 or more\n", what, values.size(), median(),
               100 * part_from(0.8F));
  }
};

/// What explain() does with samples before a backend sees them.
class Attributed {
 public:
  explicit Attributed(SampleBuffer samples) : prepared_(prepare(std::move(samples), explain_settings())) {
    groups_ = random_groups(prepared_.facts.variables);
    attribution_ = attribute_noise(prepared_.frame, groups_, 1, [] {});
  }
  float share(std::size_t group, std::size_t pixel) const {
    const auto found = std::find_if(groups_.begin(), groups_.end(),
                                    [&](const RandomGroup& g) { return g.name == group_names.at(group); });
    return attribution_.share(static_cast<std::size_t>(found - groups_.begin()), pixel);
  }

 private:
  PreparedFrame prepared_;
  std::vector<RandomGroup> groups_;
  Attribution attribution_;
};

TEST(NoiseOfCombined, IsAttributedToTheOnlyGroupThatMakesIt) {
  const Combined combined;
  constexpr std::size_t step = 2, across = width / step, down = height / step;  // every other pixel and row
  std::vector<Truth> truth(across * down);
  const auto pixel_of = [&](std::size_t i) { return i / across * step * width + i % across * step; };
  for_all(truth.size(), [&](std::size_t i) { truth[i] = measure(combined, pixel_of(i)); });
  for (const int samples : {4, 8}) {
    SceneOptions options;
    options.samples = samples;
    options.seed = 5;
    const Attributed attributed(render_scene("combined", options));
    for (std::size_t group = 0; group < 3; ++group) {
      Shares shares;
      for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i].only(group)) shares.values.push_back(attributed.share(group, pixel_of(i)));
      ASSERT_GE(shares.values.size(), 20U) << group_names.at(group);
      shares.tell(fmt::format("{}, {} samples a pixel", group_names.at(group), samples));
      EXPECT_GE(shares.median(), 0.95) << group_names.at(group);
      EXPECT_GE(shares.part_from(0.8F), 0.8) << group_names.at(group);
    }
  }
}

constexpr scene::Draw still_draw = {{0.5F, 0.5F}, {0.5F, 0.5F}, {0.5F, 0.5F}, {0.3F, 0.7F}, 0.5F, 1};

/// Whether the group makes noise of a percent and more of the brightness, and more than the film position, the only
/// other thing that differs between the samples of a pixel.
bool makes_the_noise(const Combined& combined, std::size_t group, std::size_t pixel) {
  constexpr std::uint32_t count = 64;
  const scene::PixelSampler sampler(SceneSampler::random, scene::hash(22, static_cast<std::uint32_t>(pixel)), count);
  double by_group = 0, by_film = 0, brightness = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const scene::Draw a = sampler.draw(i), b = sampler.draw((i + 1) % count);
    scene::Draw base = still_draw;
    base.film = a.film;
    const scene::Vec3 color = combined.path(pixel, with_group_of(base, a, group)).radiance;
    by_group += squared_distance(color, combined.path(pixel, with_group_of(base, b, group)).radiance) / 2;
    base.film = b.film;
    by_film += squared_distance(color, combined.path(pixel, with_group_of(base, a, group)).radiance) / 2;
    brightness += squared_distance(color, {});
  }
  return by_group > 0.01 * brightness && by_film < by_group;
}

/// `combined` with one group alive: all others have one value for all samples, while what is written about them is
/// random.
SampleBuffer with_one_group(const Combined& combined, std::size_t group, std::uint32_t samples) {
  SampleBuffer buffer;
  buffer.data_window = buffer.display_window = {0, 0, width, height};
  buffer.layout = scene::sample_layout();
  const std::size_t pixels = buffer.data_window.pixel_count(), slots = buffer.layout.size();
  for (std::size_t p = 0; p <= pixels; ++p) buffer.first_sample.push_back(static_cast<std::uint32_t>(p) * samples);
  buffer.values.resize(pixels * samples * slots);
  const SceneOptions options;
  for_all(pixels, [&](std::size_t pixel) {
    const scene::PixelSampler sampler(SceneSampler::random, scene::hash(21, static_cast<std::uint32_t>(pixel)),
                                      samples);
    for (std::uint32_t i = 0; i < samples; ++i) {
      scene::RenderedSample sample;
      sample.draw = sampler.draw(i);
      scene::Draw still = still_draw;
      still.film = sample.draw.film;
      sample.path = combined.path(pixel, with_group_of(still, sample.draw, group));
      sample.film_x = scene::film_position(pixel % width, sample.draw.film.u);
      sample.film_y = scene::film_position(pixel / width, sample.draw.film.v);
      scene::write_record(sample, combined.usage(), options, buffer.record(pixel * samples + i));
    }
  });
  return buffer;
}

TEST(NoiseOfOneGroup, IsAttributedToIt) {
  const Combined combined;
  for (std::size_t group = 0; group < 3; ++group) {
    const Attributed attributed(with_one_group(combined, group, 4));
    Shares shares;
    for (std::size_t pixel = 0; pixel < std::size_t{width} * height; pixel += 7)
      if (makes_the_noise(combined, group, pixel)) shares.values.push_back(attributed.share(group, pixel));
    ASSERT_GE(shares.values.size(), 100U) << group_names.at(group);
    shares.tell(fmt::format("{} alone", group_names.at(group)));
    EXPECT_GE(shares.median(), 0.95) << group_names.at(group);
    EXPECT_GE(shares.part_from(0.8F), 0.9) << group_names.at(group);
  }
}

}  // namespace
}  // namespace rpf
