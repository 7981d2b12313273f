#include "plan/stein_risk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "rpf/error.h"

namespace rpf {
namespace {

// The paper's constants.
constexpr double widths[] = {1, 2, 4, 8};  ///< sigma_s of the candidates, pixels
constexpr std::uint32_t candidates = sizeof widths / sizeof *widths;
constexpr double risk_width = 8;         ///< sigma of the filter of the risks
constexpr double cut = 2;                ///< standard deviations to each side
constexpr float least_variance = 1e-2F;  ///< of a feature, in its unit squared
constexpr double normal_sigma = 0.8, texture_sigma = 0.25, position_sigma = 0.6;

/// What a feature is divided by, so that it is about 1: the paper's depth is a part of the largest one.
double unit_of(const FrameFacts& facts, std::size_t feature) {
  const std::string group = group_of_variable(facts.variables.feature_names[feature]);
  if (is_world_position(group)) return facts.position_diagonal > 0 ? facts.position_diagonal : 1;
  if (group == "N" || group == "N2" || group == "albedo") return 1;
  const double deviation = facts.feature_spread.empty() ? 0 : facts.feature_spread[feature].deviation;
  return deviation > 0 ? deviation : 1;
}

double sigma_of(const std::string& name) {
  const std::string group = group_of_variable(name);
  if (group == "N" || group == "N2") return normal_sigma;
  return group == "albedo" ? texture_sigma : position_sigma;
}

int reach_of(double width) { return static_cast<int>(std::lround(cut * width)); }

float on_film(int dx, int dy, double width) {
  return static_cast<float>(std::exp(-(dx * dx + dy * dy) / (2 * width * width)));
}

class SteinRisk {
 public:
  explicit SteinRisk(PixelPlanning& planning)
      : planning_(planning),
        carried_(planning.carried()),
        count_(static_cast<std::uint32_t>(planning.facts().variables.feature_names.size())) {
    if (count_ > RPF_STEP_WEIGHTS)
      throw Error(ErrorKind::usage, fmt::format("--method sbf: {} features, at most {} are possible; name fewer groups "
                                                "with --features",
                                                count_, RPF_STEP_WEIGHTS));
    mean_ = planning_.input(PixelQuantity::mean, carried_);
    variance_ = planning_.input(PixelQuantity::variance, 3);
    mask_ = planning_.input(PixelQuantity::mask);
    std::vector<double> units;
    for (std::size_t k = 0; k < count_; ++k) units.push_back(unit_of(planning.facts(), k));
    features_ = planning_.feature_input(PixelQuantity::feature, units);
    feature_variances_ = planning_.feature_input(PixelQuantity::feature_variance, units);
    weight_ = planning_.planes(1);
    for (std::uint32_t& sums : sums_) sums = planning_.planes(carried_ + 1);
    risks_ = planning_.planes(candidates);
    risk_sums_ = planning_.planes(candidates + 1);
    smooth_risks_ = planning_.planes(candidates);
    averages_ = planning_.planes(candidates * carried_);
  }

  /// (9.15) to (9.18).
  void filter() {
    const int reach = reach_of(widths[candidates - 1]);
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx == 0 && dy == 0) continue;
        weigh(dx, dy);
        for (std::uint32_t i = 0; i < candidates; ++i)
          if (std::max(std::abs(dx), std::abs(dy)) <= reach_of(widths[i]))
            gather(dx, dy, on_film(dx, dy, widths[i]), mean_, sums_[i], carried_);
      }
    for (std::uint32_t i = 0; i < candidates; ++i) {
      planning_.step(RPF_STEP_RISK, variance_, sums_[i], risks_ + i, carried_);
      planning_.step(RPF_STEP_AVERAGE, mean_, sums_[i], averages_ + i * carried_, carried_);
    }
  }

  /// (9.19) and (9.20).
  std::uint32_t choose() {
    const int reach = reach_of(risk_width);
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx == 0 && dy == 0) continue;
        weigh(dx, dy);
        gather(dx, dy, on_film(dx, dy, risk_width), risks_, risk_sums_, candidates);
      }
    planning_.step(RPF_STEP_AVERAGE, risks_, risk_sums_, smooth_risks_, candidates);
    const std::uint32_t result = planning_.planes(carried_);
    kernel::rpf_pixel_step s{};
    s.reach = static_cast<int>(candidates);
    planning_.step(RPF_STEP_CHOOSE_LEAST, smooth_risks_, averages_, result, carried_, s);
    return result;
  }

 private:
  void weigh(int dx, int dy) {
    kernel::rpf_pixel_step s{};
    s.mask = mask_;
    s.dx = dx;
    s.dy = dy;
    s.least = least_variance;
    for (std::uint32_t k = 0; k < count_; ++k) {
      const double sigma = sigma_of(planning_.facts().variables.feature_names[k]);
      s.weights[k] = static_cast<float>(1 / (2 * sigma * sigma));
    }
    planning_.step(RPF_STEP_FEATURE_WEIGHT, features_, feature_variances_, weight_, count_, s);
  }

  void gather(int dx, int dy, float on_film, std::uint32_t in, std::uint32_t out, std::uint32_t count) {
    kernel::rpf_pixel_step s{};
    s.dx = dx;
    s.dy = dy;
    s.scale = on_film;
    planning_.step(RPF_STEP_GATHER, in, weight_, out, count, s);
  }

  PixelPlanning& planning_;
  std::uint32_t carried_, count_;
  std::uint32_t mean_ = 0, variance_ = 0, mask_ = 0, features_ = 0, feature_variances_ = 0, weight_ = 0;
  std::uint32_t sums_[candidates] = {}, risks_ = 0, risk_sums_ = 0, smooth_risks_ = 0, averages_ = 0;
};

}  // namespace

void plan_stein_risk(PixelPlanning& planning, PixelPlan& plan) {
  SteinRisk risk(planning);
  risk.filter();
  plan.result = risk.choose();
}

}  // namespace rpf
