#pragma once

#include <vector>

#include "rpf/image.h"

namespace rpf::cli {

/// R, G and B of images of equal size in a row, with a gap of white pixels, enlarged by whole pixels where they are
/// small.
Image side_by_side(const std::vector<Image>& images);

}  // namespace rpf::cli
