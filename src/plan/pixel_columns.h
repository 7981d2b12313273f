// The space of a frame's samples, and the points that pixels ask it at, as plain data (algorithm.md, section 12).
#pragma once

#include <functional>
#include <vector>

#include "frame/prepare.h"
#include "plan/sample_tree.h"
#include "rpf/settings.h"

namespace rpf {

struct PixelColumns {
  kernel::rpf_columns shape = {};
  std::vector<kernel::rpf_point> points;
  SampleTree tree;
  std::vector<float> metrics;  ///< [leaf][RPF_METRIC]
  std::vector<float> colors;   ///< [sample][carried], scaled radiance
  std::vector<float> means;    ///< [carried][pixel]

  std::size_t pixels() const { return static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height); }
  std::size_t sums() const { return (shape.carried + 1) * pixels(); }
};

/// Of a frame that prepare() made for the method; its colors are copied. Throws Error(usage) as validate() does, and
/// what `check` throws, which is called now and then.
PixelColumns make_pixel_columns(const PreparedFrame& prepared, const Settings& settings, int threads,
                                const std::function<void()>& check);

}  // namespace rpf
