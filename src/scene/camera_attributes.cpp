#include "scene/camera_attributes.h"

#include <array>

namespace rpf::scene {
namespace {

using Point = std::array<double, 3>;

/// A matrix for rows: what is multiplied with it stands to its left.
class Matrix {
 public:
  /// A column takes the vector's part of a direction, and what the origin has there.
  void set_column(std::size_t column, const Point& direction, double at_origin) {
    for (std::size_t row = 0; row < 3; ++row) values_[4 * row + column] = static_cast<float>(direction[row]);
    values_[12 + column] = static_cast<float>(at_origin);
  }
  const std::vector<float>& values() const { return values_; }

 private:
  std::vector<float> values_ = std::vector<float>(16);
};

Point point(const Vec3& v) { return {v.x, v.y, v.z}; }

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point sum(double s, const Point& a, double t, const Point& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

}  // namespace

void describe_camera(const Camera& camera, const SceneOptions& options, Metadata& metadata) {
  const Camera::Axes axes = camera.axes();
  const Point right = point(axes.right), up = point(axes.up), forward = point(axes.forward);
  const Point offset = {options.world_offset[0], options.world_offset[1], options.world_offset[2]};
  const Point eye = sum(options.world_scale, point(camera.position), 1, offset);
  // Shares of the picture's width and height at distance 1, the center at a half.
  const double across = 1 / static_cast<double>(camera.width_at_one);
  const double down = across * options.width / options.height;
  const Point x = sum(across, right, 0.5, forward), y = sum(-down, up, 0.5, forward);
  Matrix to_camera, to_ndc;
  std::size_t column = 0;
  for (const Point* axis : {&right, &up, &forward}) to_camera.set_column(column++, *axis, -dot(*axis, eye));
  to_camera.set_column(3, {}, 1);
  to_ndc.set_column(0, x, -dot(x, eye));
  to_ndc.set_column(1, y, -dot(y, eye));
  to_ndc.set_column(2, {}, 1);  // the inverse of the depth
  to_ndc.set_column(3, forward, -dot(forward, eye));
  metadata["worldToCamera"] = to_camera.values();
  metadata["worldToNDC"] = to_ndc.values();
  metadata["rpf:lensRadius"] = options.world_scale * camera.lens_radius;
  metadata["rpf:focusDistance"] = options.world_scale * camera.focus;
}

}  // namespace rpf::scene
