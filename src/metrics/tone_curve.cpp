#include "metrics/tone_curve.h"

#include <algorithm>

#include "rpf/srgb.h"

namespace rpf::metrics {

ColorPlanes clamped(const ColorPlanes& color) {
  ColorPlanes result = color;
  for (Plane& plane : result) plane = mapped(std::move(plane), [](double v) { return std::clamp(v, 0.0, 1.0); });
  return result;
}

ColorPlanes displayed(const ColorPlanes& color) {
  ColorPlanes result = clamped(color);
  for (Plane& plane : result) plane = mapped(std::move(plane), srgb_encode);
  return result;
}

}  // namespace rpf::metrics
