#include "scene/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rpf/error.h"
#include "scene/integrator.h"
#include "scene/penumbra.h"
#include "scene/random.h"
#include "scene/registry.h"

namespace rpf::scene {
namespace {

constexpr int largest = 1048576;

void check_range(const char* what, int value) {
  if (value < 1 || value > largest)
    throw Error(ErrorKind::usage, fmt::format("scene: {} is {}; 1 to {} is expected", what, value, largest));
}

void check(const SceneOptions& options) {
  check_range("the width", options.width);
  check_range("the height", options.height);
  check_range("the number of samples a pixel", options.samples);
  if (Window{0, 0, options.width, options.height}.pixel_count() >= 0xffffffffU)
    throw Error(ErrorKind::usage, fmt::format("scene: {}x{} pixels are too many; fewer than 4,294,967,295 are expected",
                                              options.width, options.height));
  if (!std::isfinite(options.world_scale) || options.world_scale <= 0)
    throw Error(ErrorKind::usage,
                fmt::format("scene: the world scale is {}; a finite number above 0 is expected", options.world_scale));
  for (const float offset : options.world_offset)
    if (!std::isfinite(offset))
      throw Error(ErrorKind::usage,
                  fmt::format("scene: the world offset has the value {}; finite numbers are expected", offset));
}

/// Checks first, so that nothing is built for options that cannot be.
World checked_world(const std::string& name, const SceneOptions& options) {
  check(options);
  return find_scene(name).build();
}

}  // namespace

std::uint32_t pixel_key(std::uint32_t seed, Stage stage, std::size_t pixel) {
  return hash(hash(hash(seed), static_cast<std::uint32_t>(stage)), static_cast<std::uint32_t>(pixel));
}

float film_position(std::size_t pixel, float offset) {
  const auto next = static_cast<float>(pixel + 1);
  return std::min(static_cast<float>(pixel) + offset, std::nextafter(next, 0.0F));
}

Renderer::Renderer(const std::string& name, const SceneOptions& options)
    : world_(checked_world(name, options)),
      usage_(world_.usage()),
      width_(options.width),
      height_(options.height),
      penumbra_(options.penumbra) {
  if (!world_.direct) tracer_ = std::make_unique<Tracer>(world_);
}

RenderedSample Renderer::render(std::size_t pixel, const PixelSampler& sampler, std::uint32_t number) const {
  RenderedSample sample;
  sample.draw = sampler.draw(number);
  const auto width = static_cast<std::size_t>(width_);
  sample.film_x = film_position(pixel % width, sample.draw.film.u);
  sample.film_y = film_position(pixel / width, sample.draw.film.v);
  if (world_.direct) {
    sample.path = world_.direct(sample.draw, sample.film_x, sample.film_y);
    return sample;
  }
  const Ray ray = world_.camera.ray(sample.film_x, sample.film_y, width_, height_, sample.draw.lens, sample.draw.time);
  sample.path = trace_path(world_, *tracer_, ray, sample.draw);
  if (penumbra_) sample.penumbra = penumbra_of(world_, *tracer_, ray, sample.path.first, sample.draw.light);
  return sample;
}

}  // namespace rpf::scene
