// One pixel's trace in the words of the public header.
#pragma once

#include "frame/prepare.h"
#include "plan/plan.h"
#include "rpf/explain.h"
#include "seam/trace.h"

namespace rpf {

/// `position`: in the coordinates of the data window. Colors are radiance again.
ExplainedPixel explain_trace(const PixelTrace& trace, const PreparedFrame& prepared, const Plan& plan,
                             const Window& data_window);

}  // namespace rpf
