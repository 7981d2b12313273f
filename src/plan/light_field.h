// The light field of a frame's samples as plain data (algorithm.md, section 11): where they are, what is asked for.
#pragma once

#include <vector>

#include "frame/prepare.h"
#include "rpf/settings.h"
#include "views.h"

namespace rpf {

struct LightField {
  kernel::rpf_light_field field = {};
  std::vector<kernel::rpf_view> views;
  std::vector<float> tracks;  ///< [sample][RPF_TRACK]
  std::vector<float> colors;  ///< [sample][carried], scaled radiance
  std::vector<float> means;   ///< [carried][pixel]

  std::size_t samples() const { return tracks.size() / RPF_TRACK; }
  std::size_t pixels() const { return static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height); }
  std::size_t sums() const { return (field.carried + 1) * pixels(); }
};

/// What is known of a light field without its camera: how far to look, and in what cells.
kernel::rpf_light_field light_field_shape(int width, int height, std::size_t carried, std::uint64_t samples);

/// Of a frame that prepare() made for the method; its colors are copied. Throws Error(usage) as validate() does.
LightField make_light_field(const PreparedFrame& prepared, const Settings& settings);

}  // namespace rpf
