// The order of rows through passes: nothing is filtered before what it reads, nothing is kept longer than it is read.
#include "run/pass_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plan/box.h"
#include "plan/regions.h"

namespace rpf {
namespace {

constexpr int width = 9;

Plan plan_of(const std::vector<int>& boxes, int height, const Window& crop) {
  Plan plan;
  plan.width = width;
  plan.height = height;
  for (const int box : boxes) {
    plan.passes.emplace_back();
    plan.passes.back().box_width = box;
  }
  plan_regions(plan, crop);
  return plan;
}

std::vector<PassStep> steps_by(int rows, const Plan& plan, const Window& crop) {
  return steps_of(plan, crop, [=](int row) { return row + rows; });
}

/// Goes through the steps as passes do.
void expect_possible(const std::vector<PassStep>& steps, const Plan& plan, int first) {
  int read = first;
  std::vector<int> done;
  for (const PassPlan& pass : plan.passes) done.push_back(pass.region.y);
  for (const PassStep& step : steps) {
    EXPECT_EQ(step.read_from, read);
    read = step.rows.end;
    for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
      const auto& [begin, end] = step.passes[pass];
      ASSERT_EQ(begin, done[pass]);
      if (begin == end) continue;
      const int reach = box_reach(plan.passes[pass].box_width);
      EXPECT_GE(std::max(begin - reach, 0), step.rows.first);
      EXPECT_LE(std::min(end + reach, plan.height), pass == 0 ? read : done[pass - 1]);
      done[pass] = end;
    }
  }
  for (std::size_t pass = 0; pass < plan.passes.size(); ++pass)
    EXPECT_EQ(done[pass], plan.passes[pass].region.y + plan.passes[pass].region.height);
}

TEST(PassSteps, FilterEveryRowOnceBehindWhatItReads) {
  for (const auto& boxes : std::vector<std::vector<int>>{{1}, {5}, {55, 35, 17, 7}, {3, 3, 3}, {7, 9}})
    for (const int height : {1, 2, 30, 200})
      for (const Window& crop : {Window{0, 0, width, height}, Window{2, height / 3, 3, std::max(height / 4, 1)}})
        for (const int rows : {1, 7, 50, 1000}) {
          const Plan plan = plan_of(boxes, height, crop);
          const int reach = box_reach(boxes.front());
          expect_possible(steps_by(rows, plan, crop), plan, std::max(plan.passes.front().region.y - reach, 0));
        }
}

TEST(PassSteps, HoldAsManyRowsAsThePassesReachAndOneMore) {
  const Window all{0, 0, width, 1000};
  const std::vector<PassStep> steps = steps_by(1, plan_of({55, 35, 17, 7}, 1000, all), all);
  int most = 0;
  for (const PassStep& step : steps) most = std::max(most, step.rows.end - step.rows.first);
  // The last pass is 27 + 17 + 8 + 3 rows behind what is read; the second one still reads 17 behind 27 + 17.
  EXPECT_EQ(most, 27 + 17 + 17 + 1);
}

TEST(PassSteps, OfNoPassReadTheCrop) {
  const Window crop{0, 20, width, 10};
  const std::vector<PassStep> steps = steps_by(4, plan_of({}, 100, crop), crop);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps.front().read_from, 20);
  EXPECT_EQ(steps.back().rows.end, 30);
  EXPECT_EQ(steps.back().rows.first, steps.back().read_from);
}

}  // namespace
}  // namespace rpf
