#include "learned/estimate_plan.h"

#include <algorithm>

namespace rpf {

bool EstimatePlan::is_live(int input) const { return std::find(live.begin(), live.end(), input) != live.end(); }

Window window_around(const EstimatePlan& plan, const Window& region) {
  const int reach = network_reach(*plan.network), cell = 1 << (plan.network->levels() - 1);
  const auto first = [&](int place) { return std::max(place - reach, 0) / cell * cell; };
  const auto last = [&](int end, int size) { return std::min((end + reach + cell - 1) / cell * cell, size); };
  const int x = first(region.x), y = first(region.y);
  return {x, y, last(region.x + region.width, plan.width) - x, last(region.y + region.height, plan.height) - y};
}

}  // namespace rpf
