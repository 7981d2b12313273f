// What the plan needs to know of a frame.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/camera_facts.h"
#include "frame/variables.h"
#include "rpf/image.h"

namespace rpf {

/// Where the values of a feature lie, over all samples of a frame.
struct FeatureSpread {
  float mean = 0;
  double deviation = 0;  ///< of its group: root of the sum of its components' variances
};

/// What was found out while the frame was prepared.
struct FrameFacts {
  int width = 0, height = 0;
  std::uint32_t max_samples_per_pixel = 0;
  Variables variables;
  float position_diagonal = 0;                ///< of the box of all first-hit world positions
  float radiance_scale = 1;                   ///< what the color was multiplied with
  std::vector<FeatureSpread> feature_spread;  ///< [feature], where the method asks for it
  CameraFacts camera;                         ///< where the method asks for it
  std::size_t carried = 3;
  Window crop;  ///< frame coordinates; the pixels that are wanted in the end
};

}  // namespace rpf
