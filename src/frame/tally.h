// How often something was found in a frame, and where first: what becomes an InputNote.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/image.h"

namespace rpf {

struct Tally {
  std::uint64_t count = 0;
  std::size_t first_pixel = 0;  ///< row-major in the data window

  void add(std::size_t pixel) {
    if (count++ == 0) first_pixel = pixel;
  }
  /// Takes over what was found in later pixels.
  void join(const Tally& later) {
    if (count == 0) first_pixel = later.first_pixel;
    count += later.count;
  }
  /// Adds a note where something was found.
  void tell(const std::string& what, const Window& data_window, std::vector<InputNote>& notes) const {
    const auto width = static_cast<std::size_t>(data_window.width);
    if (count > 0)
      notes.push_back({what, count, data_window.x + static_cast<int>(first_pixel % width),
                       data_window.y + static_cast<int>(first_pixel / width)});
  }
};

}  // namespace rpf
