// How plans of steps are written.
#pragma once

#include "plan/pixel_plan.h"

namespace rpf {

/// Hands out planes by number and adds steps.
class PixelPlanning {
 public:
  PixelPlanning(const FrameFacts& facts, PixelPlan& plan) : facts_(facts), plan_(plan) {
    plan.width = facts.width;
    plan.height = facts.height;
  }

  const FrameFacts& facts() const { return facts_; }
  std::uint32_t carried() const { return static_cast<std::uint32_t>(facts_.carried); }

  /// Planes of the frame, one for each of `channels`. Before all others.
  std::uint32_t input(PixelQuantity quantity, std::uint32_t channels = 1) {
    for (std::uint32_t c = 0; c < channels; ++c) plan_.inputs.push_back({quantity, c, 1});
    return planes(channels);
  }

  /// One plane of the frame.
  std::uint32_t input(const PixelPlane& plane) {
    plan_.inputs.push_back(plane);
    return planes(1);
  }

  /// Planes of features, each divided by its unit; of variances by the square.
  std::uint32_t feature_input(PixelQuantity quantity, const std::vector<double>& units) {
    for (std::size_t k = 0; k < units.size(); ++k) plan_.inputs.push_back({quantity, k, units[k]});
    return planes(static_cast<std::uint32_t>(units.size()));
  }

  /// Planes that are 0.
  std::uint32_t planes(std::uint32_t count) {
    const std::uint32_t first = plan_.planes;
    plan_.planes += count;
    return first;
  }

  /// A step of the picture's size, with what `rest` says.
  void step(int kind, kernel::rpf_pixel_step rest) {
    rest.kind = kind;
    rest.width = plan_.width;
    rest.height = plan_.height;
    plan_.steps.push_back(rest);
  }

  /// The same from `count` planes at `in`, and what stands at `by`, to `out`.
  void step(int kind, std::uint32_t in, std::uint32_t by, std::uint32_t out, std::uint32_t count,
            kernel::rpf_pixel_step rest = {}) {
    rest.in = in;
    rest.by = by;
    rest.out = out;
    rest.count = count;
    step(kind, rest);
  }

 private:
  const FrameFacts& facts_;
  PixelPlan& plan_;
};

}  // namespace rpf
