#include "scene/camera.h"

#include "scene/warp.h"

namespace rpf::scene {

Camera::Axes Camera::axes() const {
  const Vec3 forward = normalize(target - position);
  const Vec3 right = normalize(cross(forward, {0, 1, 0}));
  return {right, cross(right, forward), forward};
}

Ray Camera::ray(float film_x, float film_y, int width, int height, Pair lens, float time) const {
  const auto [right, up, forward] = axes();
  const float scale = width_at_one / static_cast<float>(width);
  const float x = scale * (film_x - 0.5F * static_cast<float>(width));
  const float y = scale * (0.5F * static_cast<float>(height) - film_y);
  const Pair disc = lens_radius > 0 ? to_disc(lens) : Pair{};
  const Vec3 on_lens = lens_radius * (disc.u * right + disc.v * up);
  const Vec3 in_focus = focus * (forward + x * right + y * up);
  return {position + on_lens, normalize(in_focus - on_lens), time};
}

}  // namespace rpf::scene
