#include "plan/regions.h"

#include <algorithm>

#include "plan/box.h"

namespace rpf {
namespace {

Window grown(const Window& window, int margin, int width, int height) {
  const int x0 = std::max(window.x - margin, 0), x1 = std::min(window.x + window.width + margin, width);
  const int y0 = std::max(window.y - margin, 0), y1 = std::min(window.y + window.height + margin, height);
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace

void plan_regions(Plan& plan, const Window& crop) {
  Window needed = crop;
  for (auto pass = plan.passes.rbegin(); pass != plan.passes.rend(); ++pass) {
    pass->region = needed;
    needed = grown(needed, box_reach(pass->box_width), plan.width, plan.height);
  }
}

}  // namespace rpf
