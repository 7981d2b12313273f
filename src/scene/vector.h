// Three floats: points, directions, colors.
#pragma once

#include <cmath>

namespace rpf::scene {

struct Vec3 {
  float x = 0, y = 0, z = 0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(float s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }

inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(const Vec3& a) { return 1 / length(a) * a; }
inline bool is_black(const Vec3& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/// Three orthogonal unit vectors, right-handed; z is given.
struct Frame3 {
  Vec3 x, y, z;

  Vec3 to_world(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3 to_local(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// A frame around the unit vector z (Duff et al., JCGT 6(1), 2017).
inline Frame3 frame_around(const Vec3& z) {
  const float sign = std::copysign(1.0F, z.z);
  const float a = -1 / (sign + z.z), b = z.x * z.y * a;
  return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

/// Turns v by `angle` radians around the unit vector `axis` (Rodrigues).
inline Vec3 rotate(const Vec3& v, const Vec3& axis, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (1 - c) * dot(axis, v) * axis;
}

}  // namespace rpf::scene
