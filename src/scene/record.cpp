#include "scene/record.h"

#include <fmt/format.h>

#include <limits>

namespace rpf::scene {
namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// Fills a record from left to right, in the order of sample_layout().
class Pen {
 public:
  explicit Pen(float* next) : next_(next) {}
  void put(float value) { *next_++ = value; }
  void put(const Vec3& v) {
    for (const float value : {v.x, v.y, v.z}) put(value);
  }
  void put(Pair pair) {
    put(pair.u);
    put(pair.v);
  }

 private:
  float* next_;
};

Vec3 world_position(const Vec3& p, const SceneOptions& options) {
  const auto place = [&](float value, float offset) {
    return static_cast<float>(static_cast<double>(options.world_scale) * value + offset);
  };
  return {place(p.x, options.world_offset[0]), place(p.y, options.world_offset[1]),
          place(p.z, options.world_offset[2])};
}

SurfacePoint or_missing(const SurfacePoint& point, const SceneOptions& options) {
  constexpr Vec3 nothing = {missing, missing, missing};
  if (!point.hit) return {false, nothing, nothing, nothing, {missing, missing}, nothing, nothing};
  SurfacePoint placed = point;
  for (Vec3* p : {&placed.position, &placed.opening, &placed.closing}) *p = world_position(*p, options);
  return placed;
}

/// The slots of every scene.
SampleLayout common_layout() {
  return {{"R",
           "G",
           "B",
           "film.X",
           "film.Y",
           "random.lens.U",
           "random.lens.V",
           "random.time",
           "random.light.U",
           "random.light.V",
           "random.bsdf.U",
           "random.bsdf.V",
           "feature.N.X",
           "feature.N.Y",
           "feature.N.Z",
           "feature.P.X",
           "feature.P.Y",
           "feature.P.Z",
           "feature.albedo.R",
           "feature.albedo.G",
           "feature.albedo.B",
           "feature.uv.U",
           "feature.uv.V",
           "feature.N2.X",
           "feature.N2.Y",
           "feature.N2.Z",
           "feature.P2.X",
           "feature.P2.Y",
           "feature.P2.Z",
           "feature.albedo2.R",
           "feature.albedo2.G",
           "feature.albedo2.B",
           "feature.hit"}};
}

}  // namespace

SampleLayout sample_layout(const SceneOptions& options) {
  SampleLayout layout = common_layout();
  if (options.penumbra) layout.slots.insert(layout.slots.end(), {"feature.penumbra.slope", "feature.penumbra.width"});
  for (const char* group : {"opening", "closing"})
    for (const char* axis : {"X", "Y", "Z"})
      if (options.lightfield) layout.slots.push_back(fmt::format("feature.{}.{}", group, axis));
  return layout;
}

void write_record(const RenderedSample& sample, const Usage& usage, const SceneOptions& options, float* record) {
  Pen pen(record);
  pen.put(sample.path.radiance);
  pen.put(Pair{sample.film_x, sample.film_y});
  pen.put(usage.lens ? sample.draw.lens : Pair{});
  pen.put(usage.time ? sample.draw.time : 0.0F);
  pen.put(usage.light ? sample.draw.light : Pair{});
  pen.put(usage.bsdf ? sample.draw.bsdf : Pair{});
  const SurfacePoint first = or_missing(sample.path.first, options), second = or_missing(sample.path.second, options);
  pen.put(first.normal);
  pen.put(first.position);
  pen.put(first.albedo);
  pen.put(first.uv);
  pen.put(second.normal);
  pen.put(second.position);
  pen.put(second.albedo);
  pen.put(sample.path.first.hit ? 1.0F : 0.0F);
  if (options.penumbra) {
    pen.put(first.hit ? sample.penumbra.slope : missing);
    pen.put(first.hit ? options.world_scale * sample.penumbra.width : missing);
  }
  if (!options.lightfield) return;
  pen.put(first.opening);
  pen.put(first.closing);
}

}  // namespace rpf::scene
