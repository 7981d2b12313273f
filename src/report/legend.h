#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rpf::report {

/// What the colors of a picture mean.
struct Legend {
  struct Entry {
    std::uint32_t color = 0;  ///< 0xRRGGBB in sRGB
    std::string text;
  };
  std::vector<Entry> entries;
  bool continuous = false;  ///< a bar of all colors, with the texts of the first and the last
};

/// A row of colors and texts; empty without entries.
std::string legend_html(const Legend& legend);

/// From the colors of heat_map.h: a bar from `least` to `most`.
Legend magma_legend(const std::string& least, const std::string& most);

}  // namespace rpf::report
