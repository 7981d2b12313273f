// How many samples each pixel gets.
#pragma once

#include <cstdint>
#include <vector>

#include "rpf/scene.h"

namespace rpf::scene {

/// first_sample of a sample buffer. Throws Error(usage) for a density image that does not fit, or too many samples.
std::vector<std::uint32_t> first_samples(const SceneOptions& options);

}  // namespace rpf::scene
