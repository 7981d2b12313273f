#include "plan/axis_aligned.h"

#include <algorithm>
#include <optional>

#include "frame/place_of.h"

namespace rpf {
namespace {

constexpr float cut = 3;               ///< k of (9.22), the paper's
constexpr int around = 5;              ///< pixels to each side that a pixel without occluders asks for theirs
constexpr int reach = 15;              ///< pixels to each side that are averaged
constexpr float turn = 0.0304F;        ///< largest squared difference of normals: 10 degrees
constexpr float least_albedo = 1e-3F;  ///< what a surface's color counts as at least

class AxisAligned {
 public:
  AxisAligned(float bandwidth, PixelPlanning& planning)
      : planning_(planning), carried_(planning.carried()), scale_(cut * cut * bandwidth * bandwidth / 2) {
    mean_ = planning_.input(PixelQuantity::mean, carried_);
    result_ = planning_.input(PixelQuantity::mean, carried_);
    albedo_ = planning_.input(color_of_surface("albedo.R"));
    planning_.input(color_of_surface("albedo.G"));
    planning_.input(color_of_surface("albedo.B"));
    for (std::uint32_t c = 3; c < carried_; ++c) planning_.input(PixelQuantity::mask);
    const double unit = planning_.facts().position_diagonal > 0 ? planning_.facts().position_diagonal : 1;
    slope_ = planning_.input(of_feature(PixelQuantity::least_positive, "penumbra.slope"));
    planning_.input(of_feature(PixelQuantity::least_positive, "penumbra.width", unit));
    blocked_ = planning_.input(of_feature(PixelQuantity::any_positive, "penumbra.width"));
    add_surface(unit);
    around_ = planning_.planes(2);
    falloff_ = planning_.planes(1);
    weight_ = planning_.planes(1);
  }

  std::uint32_t result() const { return result_; }

  /// (9.21) and (9.22).
  void measure() {
    const std::uint32_t rows = planning_.planes(3), sums = planning_.planes(3);
    kernel::rpf_pixel_step box{};
    box.reach = around;
    box.mask = blocked_;
    std::fill(box.weights, box.weights + around + 1, 1.0F);
    planning_.step(RPF_STEP_KERNEL_ROWS, slope_, 0, rows, 2, box);
    planning_.step(RPF_STEP_KERNEL_COLUMNS, rows, 0, sums, 2, box);
    kernel::rpf_pixel_step mean{};
    mean.reach = 1;
    planning_.step(RPF_STEP_NORMALIZE, sums, sums + 2, around_, 2, mean);
    kernel::rpf_pixel_step falloff{};
    falloff.mask = known_;
    falloff.scale = scale_;
    planning_.step(RPF_STEP_SHADOW_FALLOFF, slope_, around_, falloff_, positions_, falloff);
  }

  /// (9.23) and (9.24): along the rows, then along the columns.
  void filter() {
    const std::uint32_t plain = planning_.planes(carried_);
    kernel::rpf_pixel_step s{};
    s.least = least_albedo;
    planning_.step(RPF_STEP_WITHOUT_ALBEDO, mean_, albedo_, plain, carried_, s);
    const std::uint32_t filtered = filter_along(0, 1, filter_along(1, 0, plain));
    s.mask = falloff_;
    planning_.step(RPF_STEP_WITH_ALBEDO, filtered, albedo_, result_, carried_, s);
  }

 private:
  /// A feature that has no value anywhere, or one value everywhere, is not among the variables: 0 then.
  PixelPlane of_feature(PixelQuantity quantity, const std::string& name, double unit = 1) const {
    const auto& names = planning_.facts().variables.feature_names;
    const std::optional<std::size_t> feature = place_of(name, names);
    if (!feature) return {PixelQuantity::zero};
    return {quantity, *feature, unit};
  }

  /// 1 where it is not told: the channel is then filtered as it is.
  PixelPlane color_of_surface(const std::string& name) const {
    const PixelPlane plane = of_feature(PixelQuantity::known_mean, name);
    return plane.quantity == PixelQuantity::zero ? PixelPlane{PixelQuantity::mask} : plane;
  }

  std::uint32_t add_group(const std::string& group, double unit) {
    const FrameFacts& facts = planning_.facts();
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < facts.variables.feature_names.size(); ++k) {
      if (group_of_variable(facts.variables.feature_names[k]) != group) continue;
      const double origin = facts.feature_spread.empty() ? 0 : facts.feature_spread[k].mean;
      planning_.input(PixelPlane{PixelQuantity::known_mean, k, unit, origin});
      ++count;
    }
    return count;
  }

  /// Where the positions are known, the positions, the normals.
  void add_surface(double unit) {
    PixelPlane known{PixelQuantity::mask};
    const auto& names = planning_.facts().variables.feature_names;
    for (std::size_t k = 0; k < names.size(); ++k)
      if (group_of_variable(names[k]) == "P") known = {PixelQuantity::known, k};
    known_ = planning_.input(known);
    positions_ = add_group("P", unit);
    normals_ = add_group("N", 1);
  }

  std::uint32_t filter_along(int dx, int dy, std::uint32_t in) {
    const std::uint32_t sums = planning_.planes(carried_ + 1), out = planning_.planes(carried_);
    for (int i = -reach; i <= reach; ++i) {
      if (i == 0) continue;
      kernel::rpf_pixel_step s{};
      s.dx = i * dx;
      s.dy = i * dy;
      s.mask = known_;
      s.reach = static_cast<int>(normals_);
      s.least = turn;
      planning_.step(RPF_STEP_SURFACE_WEIGHT, known_ + 1, falloff_, weight_, positions_, s);
      s.scale = 1;
      planning_.step(RPF_STEP_GATHER, in, weight_, sums, carried_, s);
    }
    planning_.step(RPF_STEP_AVERAGE, in, sums, out, carried_);
    return out;
  }

  PixelPlanning& planning_;
  std::uint32_t carried_;
  float scale_;
  std::uint32_t mean_ = 0, result_ = 0, albedo_ = 0, slope_ = 0, blocked_ = 0, known_ = 0, positions_ = 0, normals_ = 0;
  std::uint32_t around_ = 0, falloff_ = 0, weight_ = 0;
};

}  // namespace

void plan_axis_aligned(const Settings& settings, PixelPlanning& planning, PixelPlan& plan) {
  AxisAligned shadows(settings.bandwidth, planning);
  shadows.measure();
  shadows.filter();
  plan.result = shadows.result();
}

}  // namespace rpf
