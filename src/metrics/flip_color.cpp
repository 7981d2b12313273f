#include "metrics/flip_color.h"

#include <cmath>

namespace rpf::metrics {
namespace {

using Matrix = std::array<Triple, 3>;

/// Linear sRGB to XYZ, and back (9 digits of the inverse).
constexpr Matrix to_xyz{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                         {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                         {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};
constexpr Matrix to_rgb{{{3.241003275, -1.537398934, -0.498615861},
                         {-0.969224334, 1.875930071, 0.041554224},
                         {0.055639423, -0.204011202, 1.057148933}}};

Triple product(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

const Triple& white() {
  static const Triple xyz = product(to_xyz, {1, 1, 1});
  return xyz;
}

/// XYZ over the XYZ of white.
Triple relative_xyz(const Triple& rgb) {
  const Triple xyz = product(to_xyz, rgb);
  return {xyz[0] / white()[0], xyz[1] / white()[1], xyz[2] / white()[2]};
}

/// CIE's cube root with a straight line near black.
double lab_root(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

Triple opponents(double x, double y, double z) { return {116 * y - 16, 500 * (x - y), 200 * (y - z)}; }

}  // namespace

Triple opponent_of(const Triple& rgb) {
  const Triple t = relative_xyz(rgb);
  return opponents(t[0], t[1], t[2]);
}

Triple rgb_of(const Triple& opponent) {
  const double y = (opponent[0] + 16) / 116;
  const double x = y + opponent[1] / 500, z = y - opponent[2] / 200;
  return product(to_rgb, {x * white()[0], y * white()[1], z * white()[2]});
}

Triple hunt_lab_of(const Triple& rgb) {
  const Triple t = relative_xyz(rgb);
  const Triple lab = opponents(lab_root(t[0]), lab_root(t[1]), lab_root(t[2]));
  return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

double hyab_distance(const Triple& a, const Triple& b) {
  return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

}  // namespace rpf::metrics
