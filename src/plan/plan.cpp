#include "plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "after/polish.h"
#include "after/spikes.h"
#include "plan/fixed_weights.h"
#include "rpf/error.h"
#include "trace_layout.h"

namespace rpf {
namespace {

constexpr double ln2 = 0.69314718055994530942;

// Section 3: H and a of the rejection test.
constexpr float position_rejection_factor = 30.0F;
constexpr float feature_rejection_factor = 3.0F;
constexpr float least_tolerance = 0.1F;

void require(bool holds, const std::string& message) {
  if (!holds) throw Error(ErrorKind::usage, message);
}

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
  if (settings.neighbors_factor) {
    const double enough = *settings.neighbors_factor * result.box_width * result.box_width;
    result.enough = static_cast<std::uint32_t>(std::clamp<double>(std::floor(enough), 1, most_neighbors));
  }
  result.offsets = offset_table(result.box_width);
  result.entropy = entropy_table(result.max_neighbors, settings.bins);
  result.nats_per_unit = static_cast<float>(ln2 / result.entropy.units_per_bit);
  return result;
}

Window grown(const Window& window, int margin, int width, int height) {
  const int x0 = std::max(window.x - margin, 0), x1 = std::min(window.x + window.width + margin, width);
  const int y0 = std::max(window.y - margin, 0), y1 = std::min(window.y + window.height + margin, height);
  return {x0, y0, x1 - x0, y1 - y0};
}

/// The last pass filters the crop and what polishing it reads; each pass before it also what the next one reads around
/// its own region; all of them what the steps after them read.
void plan_regions(Plan& plan, const Window& crop) {
  const int after_pass = plan.spread_spikes ? spike_reach : 0;
  plan.polished = crop;
  Window needed = grown(crop, plan.polish > 0 ? polish_reach : 0, plan.width, plan.height);
  for (auto pass = plan.passes.rbegin(); pass != plan.passes.rend(); ++pass) {
    pass->region = grown(needed, after_pass, plan.width, plan.height);
    needed = pass->region;
    needed = grown(needed, (pass->box_width - 1) / 2, plan.width, plan.height);
  }
}

}  // namespace

std::size_t pair_count(const Variables& v) {
  return kernel::rpf_pairs(static_cast<kernel::uint>(v.random_names.size()),
                           static_cast<kernel::uint>(v.feature_names.size()));
}

std::string group_of_variable(const std::string& name) { return name.substr(0, name.find('.')); }

bool is_world_position(const std::string& group) { return group == "P" || group == "P2"; }

bool is_second_hit(const std::string& group) { return !group.empty() && group.back() == '2'; }

std::uint32_t NeighborhoodSize::size(std::uint32_t samples) const {
  const std::uint64_t wanted = grows_with_samples ? std::uint64_t{box_area} * samples / 2 : fixed;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, limit));
}

std::uint32_t NeighborhoodSize::draws(std::uint32_t samples) const {
  return std::max(size(samples), samples) - samples;
}

NeighborhoodSize neighborhood_size(const Settings& settings, int box_width) {
  NeighborhoodSize result;
  result.box_area = static_cast<std::uint32_t>(box_width * box_width);
  result.grows_with_samples = settings.profile == Profile::paper && !settings.samples_factor;
  const double fixed = settings.samples_factor.value_or(0.5) * result.box_area;
  result.fixed = static_cast<std::uint32_t>(std::min<double>(std::floor(fixed), most_neighbors));
  if (settings.max_samples > 0) result.limit = std::min(settings.max_samples, most_neighbors);
  return result;
}

void validate(const Settings& s) {
  for (const int b : s.box_widths)
    require(b >= 1 && b <= 255 && b % 2 == 1,
            fmt::format("box width {}: an odd number of pixels from 1 to 255 is expected", b));
  require(s.box_widths.size() <= 100, fmt::format("{} passes: at most 100 are possible", s.box_widths.size()));
  require(!s.samples_factor || (*s.samples_factor > 0 && *s.samples_factor <= 1e6),
          fmt::format("samples factor {}: a number above 0 and up to 1e6 is expected", s.samples_factor.value_or(0)));
  require(
      !s.neighbors_factor || (*s.neighbors_factor > 0 && *s.neighbors_factor <= 1e6),
      fmt::format("neighbors factor {}: a number above 0 and up to 1e6 is expected", s.neighbors_factor.value_or(0)));
  require(s.statistics_block >= 1 && s.statistics_block <= 16,
          fmt::format("statistics block {}: a width from 1 to 16 pixels is expected", s.statistics_block));
  require(s.noise >= 1e-12F && s.noise <= 1e12F,
          fmt::format("noise {}: a number from 1e-12 to 1e12 is expected, such as 0.02", s.noise));
  require(s.bins >= 3 && s.bins <= 31 && s.bins % 2 == 1,
          fmt::format("bins {}: an odd number from 3 to 31 is expected", s.bins));
  require(s.alpha_factor >= 0 && s.alpha_factor <= 1e6F,
          fmt::format("alpha factor {}: a number from 0 to 1e6 is expected", s.alpha_factor));
  require(s.position_scale >= 1e-6F && s.position_scale <= 1e6F,
          fmt::format("position scale {}: a number from 1e-6 to 1e6 is expected", s.position_scale));
  require(s.redraws >= 0 && s.redraws <= 15, fmt::format("redraws {}: a number from 0 to 15 is expected", s.redraws));
  require(s.sigma_color >= 1e-30F && s.sigma_color <= 1e30F,
          fmt::format("sigma color {}: a radiance from 1e-30 to 1e30 is expected, such as 30", s.sigma_color));
  require(s.sigma_feature >= 1e-6F && s.sigma_feature <= 1e6F,
          fmt::format("sigma feature {}: a number from 1e-6 to 1e6 is expected, such as 0.5", s.sigma_feature));
  require(s.polish == 0 || (s.polish >= 1e-3F && s.polish <= 10),
          fmt::format("polish {}: 0 or a number from 0.001 to 10 is expected, such as 0.15", s.polish));
  require(s.threads >= 0, fmt::format("threads {}: a positive number is expected, or 0 for all cores", s.threads));
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
  if (settings.method == Method::rpf) plan.statistics_block = settings.statistics_block;
  if (settings.statistics_samples > 0) plan.statistics_samples = std::min(settings.statistics_samples, most_neighbors);
  plan.alpha_factor = settings.alpha_factor;
  plan.noise = settings.noise;
  plan.outlier_step = settings.method == Method::rpf && settings.profile == Profile::paper;
  plan.spread_spikes = settings.spread_spikes;
  plan.polish = settings.polish;
  for (std::size_t pass = 0; pass < settings.box_widths.size(); ++pass)
    plan.passes.push_back(plan_pass(facts, settings, pass));
  plan_regions(plan, facts.crop);
  return plan;
}

}  // namespace rpf
