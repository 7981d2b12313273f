#include "plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "plan/fixed_weights.h"
#include "plan/regions.h"
#include "rpf/error.h"
#include "trace_layout.h"

namespace rpf {
namespace {

constexpr double ln2 = 0.69314718055994530942;

// Section 3: H and a of the rejection test.
constexpr float position_rejection_factor = 30.0F;
constexpr float feature_rejection_factor = 3.0F;
constexpr float least_tolerance = 0.1F;

void plan_rejection(Plan& plan, const FrameFacts& facts, const Settings& settings) {
  const float position_tolerance = least_tolerance * facts.position_diagonal / settings.position_scale;
  for (const std::string& name : facts.variables.feature_names) {
    const bool takes_part = settings.reject_second_hit || !is_second_hit(group_of_variable(name));
    const float tolerance = is_world_position(group_of_variable(name)) ? position_tolerance : least_tolerance;
    plan.rejection_factor.push_back(is_world_position(group_of_variable(name)) ? position_rejection_factor
                                                                               : feature_rejection_factor);
    plan.minimum_tolerance.push_back(takes_part ? tolerance : std::numeric_limits<float>::infinity());
    if (takes_part) plan.rejecting = plan.minimum_tolerance.size();
  }
}

PassPlan plan_pass(const FrameFacts& facts, const Settings& settings, std::size_t pass) {
  PassPlan result;
  result.box_width = settings.box_widths[pass];
  if (settings.method != Method::rpf) {
    plan_fixed_weights(facts, settings, result);
    return result;
  }
  result.growth = static_cast<float>(1.0 + 0.1 * static_cast<double>(pass));
  result.neighborhood = neighborhood_size(settings, result.box_width);
  const std::uint32_t samples = facts.max_samples_per_pixel;
  result.max_neighbors = std::max(result.neighborhood.size(samples), samples);
  result.offsets = offset_table(result.box_width);
  result.entropy = entropy_table(result.max_neighbors, settings.bins);
  result.nats_per_unit = static_cast<float>(ln2 / result.entropy.units_per_bit);
  return result;
}

}  // namespace

std::size_t pair_count(const Variables& v) {
  return kernel::rpf_pairs(static_cast<kernel::uint>(v.random_names.size()),
                           static_cast<kernel::uint>(v.feature_names.size()));
}

Plan make_plan(const FrameFacts& facts, const Settings& settings) {
  validate(settings);
  if (facts.max_samples_per_pixel > most_neighbors)
    throw Error(ErrorKind::input, fmt::format("{} samples in one pixel: at most {} are possible",
                                              facts.max_samples_per_pixel, most_neighbors));
  Plan plan;
  plan.method = settings.method;
  plan.centers = centers_of(facts, settings);
  plan.width = facts.width;
  plan.height = facts.height;
  plan.variables = facts.variables;
  plan.carried = facts.carried;
  plan.most_samples = std::max(facts.max_samples_per_pixel, 1U);
  plan_rejection(plan, facts, settings);
  plan.seed = settings.seed;
  plan.attempts = static_cast<std::uint32_t>(settings.redraws) + 1;
  plan.half_bins = (settings.bins - 1) / 2;
  plan.entropy_slack = entropy_slack(settings.bins);
  if (settings.bias_correction)
    plan.information_bias = 0.5F * static_cast<float>((settings.bins - 1) * (settings.bins - 1));
  plan.alpha_factor = settings.alpha_factor;
  plan.noise = settings.noise;
  plan.outlier_step = settings.method == Method::rpf && settings.profile == Profile::paper;
  for (std::size_t pass = 0; pass < settings.box_widths.size(); ++pass)
    plan.passes.push_back(plan_pass(facts, settings, pass));
  plan_regions(plan, facts.crop);
  return plan;
}

}  // namespace rpf
