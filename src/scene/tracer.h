// Intersections, by Embree. The only file that knows it is tracer.cpp.
#pragma once

#include <memory>
#include <optional>

#include "scene/world.h"

namespace rpf::scene {

struct Hit {
  Vec3 position;
  Vec3 normal;  ///< as modeled; it may point away from the ray's origin
  Pair uv;
  const Material* material = nullptr;
  int light = -1;                ///< number of the area light that was hit, -1: none
  float distance = 0;            ///< from the ray's origin
  const Solid* solid = nullptr;  ///< that was hit; null: something that stands still
};

/// Answers are the same from any number of threads at once. Keeps a pointer to the world.
class Tracer {
 public:
  explicit Tracer(const World& world);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  std::optional<Hit> nearest(const Ray& ray) const;
  /// True where something lies on the ray before `distance`.
  bool blocked(const Ray& ray, float distance) const;

 private:
  struct Embree;
  const World& world_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace rpf::scene
