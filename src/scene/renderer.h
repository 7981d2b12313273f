// Everything that rendering one sample needs.
#pragma once

#include <memory>
#include <string>

#include "scene/record.h"
#include "scene/tracer.h"

namespace rpf::scene {

/// Which of the independent sets of random numbers of a seed is drawn.
enum class Stage : std::uint32_t { samples = 1, first_half = 2, second_half = 3 };

/// The key of a pixel's random numbers.
std::uint32_t pixel_key(std::uint32_t seed, Stage stage, std::size_t pixel);

class Renderer {
 public:
  /// Throws Error(usage) for an unknown name or options that cannot be.
  Renderer(const std::string& name, const SceneOptions& options);

  RenderedSample render(std::size_t pixel, const PixelSampler& sampler, std::uint32_t number) const;
  const Usage& usage() const { return usage_; }
  const Camera& camera() const { return world_.camera; }

 private:
  World world_;
  Usage usage_;
  int width_, height_;
  bool penumbra_;
  std::unique_ptr<Tracer> tracer_;  ///< nothing where the scene has no geometry
};

/// The position in [pixel, pixel + 1) at the offset in [0, 1): rounding to float does not reach the next pixel.
float film_position(std::size_t pixel, float offset);

}  // namespace rpf::scene
