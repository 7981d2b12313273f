#include "scene/shapes.h"

#include <algorithm>
#include <limits>

#include "scene/warp.h"

namespace rpf::scene {
namespace {

using Interval = std::array<float, 2>;  ///< distances at which a line enters and leaves; empty: first > second
constexpr Interval nowhere = {1, 0};

Interval through_sphere(const Vec3& origin, const Vec3& direction, float radius) {
  // From the point nearest to the center, so that no digits cancel.
  const float middle = -dot(origin, direction);
  const Vec3 nearest = origin + middle * direction;
  const float square = radius * radius - dot(nearest, nearest);
  if (square < 0) return nowhere;
  const float half = std::sqrt(square);
  return {middle - half, middle + half};
}

Interval through_slab(float origin, float direction, float half) {
  const float a = (-half - origin) / direction, b = (half - origin) / direction;
  if (std::isnan(a) || std::isnan(b))  // along the surface
    return {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
  return {std::min(a, b), std::max(a, b)};
}

Interval common(const Interval& a, const Interval& b) { return {std::max(a[0], b[0]), std::min(a[1], b[1])}; }

Interval through_box(const Vec3& origin, const Vec3& direction, const Vec3& half) {
  return common(through_slab(origin.x, direction.x, half.x),
                common(through_slab(origin.y, direction.y, half.y), through_slab(origin.z, direction.z, half.z)));
}

/// Normal and uv on the box's face that is nearest to the local point.
Vertex on_box(const Vec3& p, const Vec3& half) {
  const float x = std::fabs(p.x) / half.x, y = std::fabs(p.y) / half.y, z = std::fabs(p.z) / half.z;
  if (x >= y && x >= z) return {p, {std::copysign(1.0F, p.x), 0, 0}, {p.z, p.y}};
  if (y >= z) return {p, {0, std::copysign(1.0F, p.y), 0}, {p.x, p.z}};
  return {p, {0, 0, std::copysign(1.0F, p.z)}, {p.x, p.y}};
}

Vertex on_sphere(const Vec3& p) {
  const Vec3 normal = normalize(p);
  const float u = std::atan2(normal.z, normal.x) / (2 * pi) + 0.5F;
  return {p, normal, {u, std::acos(std::clamp(normal.y, -1.0F, 1.0F)) / pi}};
}

}  // namespace

void add_rectangle(Mesh& mesh, const Rectangle& r) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3 n = r.normal();
  mesh.vertices.push_back({r.corner, n, {0, 0}});
  mesh.vertices.push_back({r.corner + r.edge_u, n, {1, 0}});
  mesh.vertices.push_back({r.corner + r.edge_u + r.edge_v, n, {1, 1}});
  mesh.vertices.push_back({r.corner + r.edge_v, n, {0, 1}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

std::optional<float> Solid::intersect(const Ray& ray, float nearest, float farthest) const {
  const Vec3 origin = to_local(ray.origin - center_at(ray.time), ray.time);
  const Vec3 direction = to_local(ray.direction, ray.time);
  const Interval inside =
      kind == Kind::sphere ? through_sphere(origin, direction, half_size.x) : through_box(origin, direction, half_size);
  if (inside[0] > inside[1]) return std::nullopt;
  for (const float distance : inside)
    if (distance > nearest && distance < farthest) return distance;
  return std::nullopt;
}

Vec3 Solid::carried(const Vec3& point, float from, float to) const {
  if (!moves()) return point;
  return center_at(to) + rotate(to_local(point - center_at(from), from), axis, angle + turn * to);
}

Vertex Solid::surface(const Vec3& point, float time) const {
  const Vec3 local = to_local(point - center_at(time), time);
  Vertex vertex = kind == Kind::sphere ? on_sphere(local) : on_box(local, half_size);
  vertex.position = point;
  vertex.normal = rotate(vertex.normal, axis, angle + turn * time);
  return vertex;
}

}  // namespace rpf::scene
