// Work on all pixels, in pieces between which the caller is told and asked.
#pragma once

#include <functional>

#include "rpf/filter.h"

namespace rpf::scene {

struct Work {
  std::size_t pixels = 0;
  double samples_per_pixel = 1;  ///< on average: how large a piece is
  int threads = 0;               ///< 0: available_threads()
};

/// Calls `render` for every pixel, from several threads. Throws Error(cancelled) where the caller wants to stop.
void for_all_pixels(const Work& work, const Control& control, const std::function<void(std::size_t)>& render);

}  // namespace rpf::scene
