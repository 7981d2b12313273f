// Where a camera and its lens are, as attributes of a sample file (docs/file-format.md).
#pragma once

#include "rpf/scene.h"
#include "scene/camera.h"

namespace rpf::scene {

/// Adds OpenEXR's worldToCamera and worldToNDC, rpf:lensRadius and rpf:focusDistance, all for positions as they are
/// written.
void describe_camera(const Camera& camera, const SceneOptions& options, Metadata& metadata);

}  // namespace rpf::scene
