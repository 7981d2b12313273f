// From paths to records of a sample buffer.
#pragma once

#include "rpf/samples.h"
#include "rpf/scene.h"
#include "scene/world.h"

namespace rpf::scene {

/// The slots that every scene has, and those that the options ask for.
SampleLayout sample_layout(const SceneOptions& options = {});

/// A sample on its way to its record.
struct RenderedSample {
  float film_x = 0, film_y = 0;  ///< pixels
  Draw draw;
  Path path;
  Penumbra penumbra;
};

/// Writes one record of sample_layout(options).
void write_record(const RenderedSample& sample, const Usage& usage, const SceneOptions& options, float* record);

}  // namespace rpf::scene
