#include "run/pass_steps.h"

#include <algorithm>

#include "plan/box.h"

namespace rpf {
namespace {

RowRange rows_of(const Window& region) { return {region.y, region.y + region.height}; }

int reach_of(const PassPlan& pass) { return box_reach(pass.box_width); }

/// The rows that the first pass reads, or the crop where there is none.
RowRange rows_to_read(const Plan& plan, const Window& crop) {
  if (plan.passes.empty()) return rows_of(crop);
  const RowRange rows = rows_of(plan.passes.front().region);
  const int reach = reach_of(plan.passes.front());
  return {std::max(rows.first - reach, 0), std::min(rows.end + reach, plan.height)};
}

/// The first row that any pass still reads, where those before done[pass] are filtered.
int first_needed(const Plan& plan, const std::vector<int>& done, int otherwise) {
  int first = otherwise;
  for (std::size_t pass = 0; pass < plan.passes.size(); ++pass)
    if (done[pass] < rows_of(plan.passes[pass].region).end)
      first = std::min(first, std::max(done[pass] - reach_of(plan.passes[pass]), 0));
  return first;
}

}  // namespace

std::vector<PassStep> steps_of(const Plan& plan, const Window& crop, const std::function<int(int)>& read_end) {
  const RowRange all = rows_to_read(plan, crop);
  std::vector<int> done;  // [pass] rows before it are filtered
  for (const PassPlan& pass : plan.passes) done.push_back(pass.region.y);
  std::vector<PassStep> steps;
  for (int read = all.first; read < all.end;) {
    PassStep step;
    step.read_from = read;
    read = std::min(read_end(read), all.end);
    step.rows = {std::min(first_needed(plan, done, step.read_from), step.read_from), read};
    int ready = read, last = all.end;  // where what the pass reads ends by now, and in the end
    for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
      const RowRange region = rows_of(plan.passes[pass].region);
      const int end = ready == last ? region.end : std::min(ready - reach_of(plan.passes[pass]), region.end);
      step.passes.push_back({done[pass], std::max(end, done[pass])});
      done[pass] = ready = step.passes.back().end;
      last = region.end;
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace rpf
