// Pictures of one frame that the reader of a page compares, pixel by pixel: what it takes beside viewer.js.
#pragma once

#include <string>
#include <vector>

#include "report/legend.h"
#include "rpf/image.h"

namespace rpf::report {

enum class LayerKind {
  light,  ///< R, G, B in linear light: exposure and tone are the reader's
  error,  ///< one channel, in the colors and on the scale of heat_map()
  color,  ///< R, G, B of a picture that is drawn as it is; further channels are parts of a whole, told in percent
};

struct ViewerLayer {
  std::string name;  ///< "plain mean"
  LayerKind kind = LayerKind::light;
  Image image;
  Legend legend = {};
};

struct Viewer {
  std::vector<ViewerLayer> layers;  ///< of one size; pixels count as the first one's data window does
  std::size_t left = 0, right = 1;  ///< layers that are shown first
};

/// Frames of at most so many pixels keep every bit of their light; of larger ones, four decimal digits.
constexpr std::size_t exact_pixels = std::size_t{1} << 18;

/// Whether the page has the values of light to the last bit.
bool is_exact(const Viewer& viewer);

/// Markup, values and what viewer.js must know of them.
std::string viewer_html(const Viewer& viewer);

}  // namespace rpf::report
