#include "plan/light_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/pixel_planes.h"
#include "plan/sequence.h"
#include "plan/tracks.h"

namespace rpf {
namespace {

constexpr double empty_circle = 2.4;  ///< radius of the largest, for one sample a pixel: (11.3)
constexpr double widest = 8;          ///< pixels
constexpr int finest = 64;            ///< cells a pixel
constexpr double pi = 3.14159265358979323846;

/// Concentric squares become circles (Shirley and Chiu 1997).
std::array<double, 2> in_disc(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::fabs(a) > std::fabs(b);
  const double r = wide ? a : b, angle = wide ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
  return {r * std::cos(angle), r * std::sin(angle)};
}

kernel::rpf_view view(int n) {
  const auto [x, y, time, u, v] = place_in_sequence(n);
  const auto [on_right, on_up] = in_disc(u, v);
  return {static_cast<float>(on_right), static_cast<float>(on_up), static_cast<float>(time), static_cast<float>(x),
          static_cast<float>(y)};
}

void take_camera(const CameraFacts& camera, const std::array<double, 3>& origin, kernel::rpf_lens& lens) {
  const auto take = [&](const CameraFacts::Row& row, float* to) {
    double constant = row[3];
    for (std::size_t k = 0; k < 3; ++k) {
      constant += row[k] * origin[k];
      to[k] = static_cast<float>(row[k]);
    }
    to[3] = static_cast<float>(constant);
  };
  for (std::size_t k = 0; k < 3; ++k) take(camera.film[k], lens.film[k]);
  take(camera.depth, lens.depth);
  for (std::size_t k = 0; k < 2; ++k) {
    lens.right[k] = static_cast<float>(camera.right[k]);
    lens.up[k] = static_cast<float>(camera.up[k]);
  }
  lens.inverse_focus = static_cast<float>(camera.inverse_focus);
}

}  // namespace

kernel::rpf_light_field light_field_shape(int width, int height, std::size_t carried, std::uint64_t samples) {
  kernel::rpf_light_field field{};
  field.width = width;
  field.height = height;
  field.carried = static_cast<kernel::uint>(carried);
  const double density = static_cast<double>(samples) / width / height;
  const double reach = std::min(empty_circle / std::sqrt(std::max(density, 1e-6)), widest);
  field.reach = static_cast<float>(reach);
  field.finer = std::clamp(static_cast<int>(1 / reach), 1, finest);
  field.margin = static_cast<int>(std::ceil(reach * field.finer)) + 1;
  return field;
}

LightField make_light_field(const PreparedFrame& prepared, const Settings& settings) {
  validate(settings);
  const Frame& frame = prepared.frame;
  LightField result;
  result.field = light_field_shape(frame.width, frame.height, prepared.facts.carried, frame.sample_count());
  const std::array<double, 3> origin = middle_of_positions(prepared.facts);
  take_camera(prepared.facts.camera, origin, result.field.lens);
  for (int n = 0; n < settings.views; ++n) result.views.push_back(view(n));
  result.tracks = sample_tracks(prepared, origin);
  result.colors = prepared.colors;
  result.means = pixel_means(prepared);
  return result;
}

}  // namespace rpf
