// What is far in which direction, where a leaf of samples is: from how their colors differ (algorithm.md, section 12).
#pragma once

#include <functional>
#include <vector>

#include "frame/frame.h"
#include "plan/sample_tree.h"

namespace rpf {

/// [leaf][RPF_METRIC]: (12.3) to (12.5), the same bits for any number of threads. Calls `check` now and then.
std::vector<float> leaf_metrics(const SampleTree& tree, const Frame& frame, int threads,
                                const std::function<void()>& check);

}  // namespace rpf
