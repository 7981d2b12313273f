// Parts of a frame that is filtered by several processes: rows, and how they become a whole again.
#pragma once

#include <string>
#include <vector>

#include "rpf/image.h"

namespace rpf::cli {

/// The rows of "--rows A-B" or "--rows PART/PARTS" as a crop of the frame. Throws Error(usage).
Window rows_of(const std::string& text, const Window& data_window);

/// Says in the attributes rpf:rows and rpf:frameWindow which part of which frame an image is.
void mark_part(Image& image, const Window& data_window);

/// Whether an image is marked as this part of the frame.
bool is_part(const Image& image, const Window& part, const Window& data_window);

/// Files that hold parts of one image, as that image. Throws Error(input) where one is no part, where they were made of
/// another input, with other settings or of another frame, where rows are there twice or are missing: then it says
/// which.
Image joined(const std::vector<std::string>& paths);

}  // namespace rpf::cli
