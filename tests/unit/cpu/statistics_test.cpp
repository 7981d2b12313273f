// Sections 4 and 5 of the reference on neighborhoods with known answers.
#include "cpu/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tolerances.h"

namespace rpf {
namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// A plan with one random parameter and one feature: variables R G B x y r f.
Plan small_plan(std::uint32_t neighbors) {
  Plan plan;
  plan.variables.random_names = {"lens.U"};
  plan.variables.feature_names = {"depth"};
  plan.entropy_slack = entropy_slack(7);
  plan.passes.resize(1);
  plan.passes[0].entropy = entropy_table(neighbors, 7);
  plan.passes[0].nats_per_unit = static_cast<float>(std::log(2.0) / plan.passes[0].entropy.units_per_bit);
  return plan;
}

/// Neighbor j has the values row(j); not shifted.
template <typename Row>
Neighborhood neighborhood(std::uint32_t size, Row row) {
  Neighborhood n;
  for (std::uint32_t j = 0; j < size; ++j) {
    const std::vector<float> values = row(static_cast<int>(j));
    n.neighbors.push_back(j);
    n.shift.assign(values.size(), 0.0F);
    n.rows.insert(n.rows.end(), values.begin(), values.end());
  }
  return n;
}

Dependencies dependencies_of(const Plan& plan, const Neighborhood& n) {
  Dependencies d;
  measure_dependencies(plan, 0, n, d);
  return d;
}

// Pairs: R|x R|y R|r R|f G|x ... B|f f|x f|y f|r.
enum Pair { r_x, r_y, r_r, r_f, g_x, g_y, g_r, g_f, b_x, b_y, b_r, b_f, f_x, f_y, f_r };

TEST(MutualInformation, OfIdenticalVariablesIsTheirEntropy) {
  const Plan plan = small_plan(64);
  const auto n = neighborhood(64, [](int j) {
    const auto v = static_cast<float>(j % 4 - 2);
    return std::vector<float>{v, 0, 0, 0, 0, v, 0};
  });
  EXPECT_NEAR(dependencies_of(plan, n).information[r_r], std::log(4.0), test::tolerance::information);
}

TEST(MutualInformation, OfExactlyIndependentVariablesIsZero) {
  const Plan plan = small_plan(60);
  // 3 x 5 grid, four times: joint counts are products of marginals, whose logarithms no table holds exactly.
  const auto n = neighborhood(60, [](int j) {
    return std::vector<float>{static_cast<float>(j % 3 - 1), 0, 0, static_cast<float>(j / 3 % 5 - 2), 0, 0, 0};
  });
  EXPECT_EQ(dependencies_of(plan, n).information[r_x], 0.0F);
}

TEST(MutualInformation, OfAKnownTable) {
  // Joint counts [[3, 1], [1, 3]]: I = sum p ln(p / (p_x p_y)) = 2 * 3/8 ln(3/2) + 2 * 1/8 ln(1/2).
  const Plan plan = small_plan(8);
  const auto n = neighborhood(8, [](int j) {
    const float x = j < 4 ? 0 : 1, y = (j % 4 < 3) == (j < 4) ? 0 : 1;
    return std::vector<float>{0, x, 0, 0, 0, 0, y};
  });
  const Dependencies d = dependencies_of(plan, n);
  EXPECT_NEAR(d.information[g_f], 0.75 * std::log(1.5) + 0.25 * std::log(0.5), test::tolerance::information);
  EXPECT_EQ(d.information[g_r], 0.0F);
}

TEST(MutualInformation, BiasCorrectionSubtractsTheKnownBias) {
  Plan plan = small_plan(64);
  plan.information_bias = 18;  // (7 - 1)^2 / 2
  const auto n = neighborhood(64, [](int j) {
    const auto v = static_cast<float>(j % 4 - 2);
    return std::vector<float>{v, 0, 0, 0, 0, v, 0};
  });
  EXPECT_NEAR(dependencies_of(plan, n).information[r_r], std::log(4.0) - 36.0 / (2 * 64), test::tolerance::information);
}

TEST(Weights, OfColorsThatOnlyTheLensMoves) {
  const Plan plan = small_plan(64);
  const auto n = neighborhood(64, [](int j) {
    const auto v = static_cast<float>(j % 4 - 2), w = static_cast<float>(j / 4 % 4 - 2);
    return std::vector<float>{v, v, v, 0, 0, v, w};
  });
  FilterWeights weights;
  compute_weights(plan, 0, dependencies_of(plan, n), weights);
  EXPECT_NEAR(weights.color.fraction_random, 1.0, test::tolerance::formula);
  EXPECT_EQ(weights.color.alpha[0], 0.0F);
  EXPECT_EQ(weights.beta[0], 0.0F);  // the color does not depend on the feature
}

TEST(Weights, OfColorsThatFollowAFeatureAndThePosition) {
  const Plan plan = small_plan(64);
  const auto n = neighborhood(64, [](int j) {
    const auto v = static_cast<float>(j % 4 - 2), w = static_cast<float>(j / 4 % 4 - 2);
    return std::vector<float>{v, v, v, v, 0, w, v};
  });
  FilterWeights weights;
  compute_weights(plan, 0, dependencies_of(plan, n), weights);
  EXPECT_EQ(weights.color.fraction_random, 0.0F);
  EXPECT_EQ(weights.color.alpha[2], 1.0F);
  EXPECT_NEAR(weights.fraction_feature[0], 0.5, test::tolerance::formula);  // D_c^f = D_c^p
  EXPECT_NEAR(weights.beta[0], 0.5, test::tolerance::formula);
}

TEST(Normalize, LeavesMissingValuesOutAndAtZero) {
  auto n =
      neighborhood(5, [](int j) { return std::vector<float>{j == 2 ? missing : static_cast<float>(j)}; });  // 0 1 3 4
  Normalization out;
  normalize(n, out);
  EXPECT_EQ(out.mean[0], 2.0F);
  EXPECT_NEAR(1 / out.inverse_deviation[0], std::sqrt(2.5), test::tolerance::formula);
  EXPECT_EQ(n.rows[2], 0.0F);
  EXPECT_NEAR(n.rows[4], 2 / std::sqrt(2.5), test::tolerance::formula);
}

TEST(Normalize, OfAConstantOrAllMissingVariableIsZero) {
  auto n = neighborhood(20, [](int) { return std::vector<float>{1e7F, missing}; });
  Normalization out;
  normalize(n, out);
  for (const float value : n.rows) EXPECT_EQ(value, 0.0F);
}

}  // namespace
}  // namespace rpf
