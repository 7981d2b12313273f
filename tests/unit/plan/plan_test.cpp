#include "plan/plan.h"

#include <gtest/gtest.h>

#include <limits>

#include "rpf/error.h"

namespace rpf {
namespace {

FrameFacts facts() {
  FrameFacts f;
  f.width = 100;
  f.height = 80;
  f.max_samples_per_pixel = 4;
  f.variables.random_names = {"lens.U"};
  f.variables.feature_names = {"N.X", "P.X", "P2.X", "albedo.R"};
  f.position_diagonal = 10;
  f.crop = {0, 0, 100, 80};
  return f;
}

TEST(NeighborhoodSize, IsHalfTheBoxInTheThesisAndGrowsInThePaper) {
  Settings thesis, paper;
  paper.profile = Profile::paper;
  EXPECT_EQ(neighborhood_size(thesis, 55).size(4), 1512U);
  EXPECT_EQ(neighborhood_size(thesis, 7).size(4), 24U);
  EXPECT_EQ(neighborhood_size(thesis, 7).draws(4), 20U);
  EXPECT_EQ(neighborhood_size(thesis, 3).draws(8), 0U);
  EXPECT_EQ(neighborhood_size(paper, 55).size(4), 6050U);
  EXPECT_EQ(neighborhood_size(paper, 7).size(3), 73U);
  EXPECT_EQ(neighborhood_size(paper, 7).size(0), 0U);
  EXPECT_EQ(neighborhood_size(paper, 7).size(513), 12544U);  // as of 512: more gain nothing and cost much
}

TEST(NeighborhoodSize, FollowsFactorAndLimit) {
  Settings settings;
  settings.profile = Profile::paper;
  settings.samples_factor = 2.0;
  EXPECT_EQ(neighborhood_size(settings, 21).size(4), 882U);
  settings.max_samples = 100;
  EXPECT_EQ(neighborhood_size(settings, 21).size(4), 100U);
  EXPECT_EQ(neighborhood_size(settings, 255).size(1U << 20), 100U);
}

TEST(Plan, HasToleranceAndFactorOfEveryFeature) {
  const Plan plan = make_plan(facts(), {});
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(plan.rejection_factor, (std::vector<float>{3, 30, 30, 3}));
  EXPECT_EQ(plan.minimum_tolerance, (std::vector<float>{0.1F, 0.05F, infinity, 0.1F}));
  Settings all;
  all.reject_second_hit = true;
  all.position_scale = 1;
  EXPECT_EQ(make_plan(facts(), all).minimum_tolerance, (std::vector<float>{0.1F, 1, 1, 0.1F}));
}

TEST(Plan, AllowsOneAttemptMoreThanRedraws) {
  Settings settings;
  EXPECT_EQ(make_plan(facts(), settings).attempts, 9U);
  settings.redraws = 0;
  EXPECT_EQ(make_plan(facts(), settings).attempts, 1U);
}

TEST(Plan, GrowsTheRegionOfEarlierPasses) {
  FrameFacts f = facts();
  f.crop = {50, 0, 10, 10};
  Settings settings;
  settings.box_widths = {9, 5, 3};
  const Plan plan = make_plan(f, settings);
  EXPECT_EQ(plan.passes[2].region, (Window{50, 0, 10, 10}));
  EXPECT_EQ(plan.passes[1].region, (Window{49, 0, 12, 11}));
  EXPECT_EQ(plan.passes[0].region, (Window{47, 0, 16, 13}));
}

TEST(Plan, RefusesSettingsThatCannotBe) {
  const auto refused = [](auto change) {
    Settings settings;
    change(settings);
    try {
      make_plan(facts(), settings);
    } catch (const Error& e) {
      return e.kind() == ErrorKind::usage;
    }
    return false;
  };
  EXPECT_FALSE(refused([](Settings&) {}));
  EXPECT_TRUE(refused([](Settings& s) { s.box_widths = {8}; }));
  EXPECT_TRUE(refused([](Settings& s) { s.box_widths = {257}; }));
  EXPECT_TRUE(refused([](Settings& s) { s.box_widths = {-3}; }));
  EXPECT_TRUE(refused([](Settings& s) { s.bins = 6; }));
  EXPECT_TRUE(refused([](Settings& s) { s.noise = 0; }));
  EXPECT_TRUE(refused([](Settings& s) { s.noise = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](Settings& s) { s.samples_factor = -1; }));
  EXPECT_TRUE(refused([](Settings& s) { s.redraws = 16; }));
  EXPECT_TRUE(refused([](Settings& s) { s.position_scale = 0; }));
  EXPECT_TRUE(refused([](Settings& s) { s.alpha_factor = -1; }));
  EXPECT_TRUE(refused([](Settings& s) { s.threads = -1; }));
}

}  // namespace
}  // namespace rpf
