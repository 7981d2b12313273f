#include "plan/non_local_means.h"

#include "plan/box.h"

namespace rpf {
namespace {

// The paper's constants.
constexpr int patch_reach = 3;        ///< f: patches of 7 x 7 pixels
constexpr float least_share = 0.05F;  ///< a smaller weight is none

/// epsilon of (9.4), in scaled radiance squared: far below every variance, it only makes 0 of 0 / 0.
constexpr float least_variance = 1e-10F;

/// One half buffer: its planes, what filters it, and where its sums go.
struct Half {
  std::uint32_t values = 0, guide = 0, sums = 0;
};

class NonLocalMeans {
 public:
  NonLocalMeans(const Settings& settings, PixelPlanning& planning)
      : planning_(planning), damping_(settings.damping * settings.damping), reach_(box_reach(settings.window)) {
    const std::uint32_t carried = planning_.carried();
    halves_[0].values = planning_.input(PixelQuantity::first_half, carried);
    halves_[1].values = planning_.input(PixelQuantity::second_half, carried);
    halves_[0].guide = halves_[1].values;  // each is filtered by what the other says
    halves_[1].guide = halves_[0].values;
    variance_ = planning_.input(PixelQuantity::half_variance, 3);
    mask_ = planning_.input(PixelQuantity::mask);
    counts_ = planning_.input(PixelQuantity::first_count);
    planning_.input(PixelQuantity::second_count);
    for (Half& half : halves_) half.sums = planning_.planes(carried + 1);
    distance_ = planning_.planes(2);
    distance_rows_ = planning_.planes(2);
    weight_ = planning_.planes(3);
    weight_rows_ = planning_.planes(1);
    share_ = planning_.planes(2);
  }

  void gather() {
    for (int dy = -reach_; dy <= reach_; ++dy)
      for (int dx = -reach_; dx <= reach_; ++dx)
        for (const Half& half : halves_)
          if (dx != 0 || dy != 0) gather_from(half, dx, dy);
  }

  /// (9.8) and (9.9).
  std::uint32_t finish() {
    const std::uint32_t carried = planning_.carried(), filtered = planning_.planes(2 * carried),
                        result = planning_.planes(carried);
    for (std::uint32_t i = 0; i < 2; ++i) {
      kernel::rpf_pixel_step average{};
      average.in = halves_[i].values;
      average.by = halves_[i].sums;
      average.out = filtered + i * carried;
      average.count = carried;
      planning_.step(RPF_STEP_AVERAGE, average);
    }
    planning_.step(RPF_STEP_MIX, filtered, counts_, result, carried);
    return result;
  }

 private:
  /// The neighbors at one place, of all pixels.
  void gather_from(const Half& half, int dx, int dy) {
    kernel::rpf_pixel_step s{};
    s.dx = dx;
    s.dy = dy;
    s.reach = patch_reach;
    s.mask = mask_;
    s.scale = damping_;
    s.least = least_variance;
    planning_.step(RPF_STEP_PATCH_DISTANCE, half.guide, variance_, distance_, 3, s);
    planning_.step(RPF_STEP_BOX_ROWS, distance_, 0, distance_rows_, 2, s);
    planning_.step(RPF_STEP_PATCH_WEIGHT, distance_rows_, distance_ + 1, weight_, 1, s);
    planning_.step(RPF_STEP_BOX_ROWS, weight_, 0, weight_rows_, 1, s);
    s.least = least_share;
    s.mask = weight_ + 2;  // pairs of the patch
    planning_.step(RPF_STEP_PATCH_SHARE, weight_rows_, distance_ + 1, share_, 1, s);
    s.scale = 1;
    planning_.step(RPF_STEP_GATHER, half.values, share_, half.sums, planning_.carried(), s);
  }

  PixelPlanning& planning_;
  float damping_;
  int reach_;
  Half halves_[2];
  std::uint32_t variance_ = 0, mask_ = 0, counts_ = 0;
  std::uint32_t distance_ = 0, distance_rows_ = 0, weight_ = 0, weight_rows_ = 0, share_ = 0;
};

}  // namespace

void plan_non_local_means(const Settings& settings, PixelPlanning& planning, PixelPlan& plan) {
  NonLocalMeans means(settings, planning);
  means.gather();
  plan.result = means.finish();
}

}  // namespace rpf
