// What scenes are built of: triangle meshes, which stand still, and solids, which may move and turn.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/sampler.h"
#include "scene/vector.h"

namespace rpf::scene {

struct Ray {
  Vec3 origin, direction;  ///< direction: unit vector
  float time = 0;          ///< [0, 1): place in the shutter interval
};

struct Vertex {
  Vec3 position, normal;  ///< normal: as modeled; it may point to either side
  Pair uv;
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t material = 0;
  int light = -1;  ///< number of the area light that this mesh is, -1: none
};

/// Corner and two edges; the normal is that of edge_u x edge_v. Texture coordinates run from 0 to 1 along the edges.
struct Rectangle {
  Vec3 corner, edge_u, edge_v;

  Vec3 normal() const { return normalize(cross(edge_u, edge_v)); }
  float area() const { return length(cross(edge_u, edge_v)); }
};

void add_rectangle(Mesh& mesh, const Rectangle& rectangle);

/// A sphere or a box that may move along a line and turn around its center during the shutter interval.
struct Solid {
  enum class Kind { sphere, box };
  Kind kind = Kind::sphere;
  Vec3 center;                ///< at time 0
  Vec3 half_size;             ///< box: half of its edges; sphere: x is the radius
  Vec3 velocity;              ///< scene units in the whole interval
  Vec3 axis = {0, 1, 0};      ///< unit vector
  float angle = 0, turn = 0;  ///< radians around the axis: at time 0, and in the whole interval
  std::uint32_t material = 0;

  bool moves() const { return !is_black(velocity) || turn != 0; }
  /// Radius of the sphere around the center that holds the solid.
  float reach() const { return kind == Kind::sphere ? half_size.x : length(half_size); }
  /// Distance to the first surface between the two distances, nothing if there is none.
  std::optional<float> intersect(const Ray& ray, float nearest, float farthest) const;
  /// Normal (outwards) and texture coordinates of a point on the surface.
  Vertex surface(const Vec3& point, float time) const;
  /// Where a point that the solid has at one time is at another.
  Vec3 carried(const Vec3& point, float from, float to) const;

 private:
  Vec3 to_local(const Vec3& v, float time) const { return rotate(v, axis, -(angle + turn * time)); }
  Vec3 center_at(float time) const { return center + time * velocity; }
};

}  // namespace rpf::scene
