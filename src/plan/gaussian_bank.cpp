#include "plan/gaussian_bank.h"

#include <cmath>

namespace rpf {
namespace {

// The paper's constants: eight Gaussians from 1 / sqrt(2) pixels on, each sqrt(2) times as wide as the one before;
// stops are smoothed over twice that width.
constexpr int widths = 8;
constexpr double smoothing = 2;
constexpr double cut = 3;  ///< standard deviations to each side

double width_of(int level) { return std::sqrt(0.5) * std::pow(std::sqrt(2.0), level); }

/// zeta of (9.13).
float most_trust(float gamma) { return static_cast<float>(-std::log(1 - std::pow(1.9 * gamma, std::sqrt(0.5)))); }

/// beta of (9.12): 1 against the unfiltered picture, which has no bias.
float bias_ratio(int level) {
  if (level == 0) return 1;
  const double coarse = std::pow(width_of(level), 2), fine = std::pow(width_of(level - 1), 2);
  return static_cast<float>((coarse + fine) / (coarse - fine));
}

class GaussianBank {
 public:
  explicit GaussianBank(PixelPlanning& planning) : planning_(planning), carried_(planning.carried()) {
    finest_ = planning_.input(PixelQuantity::mean, carried_);
    planning_.input(PixelQuantity::count);
    planning_.input(PixelQuantity::variance, 3);
    mask_ = planning_.input(PixelQuantity::mask);
    open_ = planning_.input(PixelQuantity::mask);
    planning_.input(PixelQuantity::mean, carried_);
    for (std::uint32_t& level : levels_) level = planning_.planes(carried_ + 4);
    rows_ = planning_.planes(carried_ + 2);
    sums_ = planning_.planes(carried_ + 2);
    variance_sums_ = planning_.planes(4);
    stops_ = planning_.planes(3);
  }

  std::uint32_t result() const { return open_ + 1; }

  void add_level(int number, float trust) {
    const std::uint32_t fine = number == 0 ? finest_ : levels_[(number + 1) % 2], coarse = levels_[number % 2];
    blur(width_of(number), coarse);
    kernel::rpf_pixel_step stop{};
    stop.mask = (number == 0 ? fine : coarse) + carried_;
    stop.scale = bias_ratio(number);
    stop.least = trust;
    planning_.step(RPF_STEP_STOP, fine, coarse, stops_, carried_, stop);
    convolve(gaussian(smoothing * width_of(number)), stops_, 1, stops_ + 1);
    planning_.step(RPF_STEP_CHOOSE_SCALE, stops_, coarse, open_, carried_);
  }

 private:
  /// A kernel along one axis: reach and weights, 1 in the middle.
  static kernel::rpf_pixel_step gaussian(double sigma) {
    kernel::rpf_pixel_step kernel{};
    kernel.reach = static_cast<int>(std::ceil(cut * sigma));
    for (int i = 0; i <= kernel.reach; ++i)
      kernel.weights[i] = static_cast<float>(std::exp(-i * i / (2 * sigma * sigma)));
    return kernel;
  }

  /// Sums of `count` planes, and the weights' sum behind them.
  void convolve(kernel::rpf_pixel_step kernel, std::uint32_t in, std::uint32_t count, std::uint32_t out) {
    kernel.in = in;
    kernel.mask = mask_;
    kernel.count = count;
    kernel.out = rows_;
    planning_.step(RPF_STEP_KERNEL_ROWS, kernel);
    kernel.in = rows_;
    kernel.out = out;
    planning_.step(RPF_STEP_KERNEL_COLUMNS, kernel);
  }

  /// (9.10) and (9.11): a level, from the unfiltered picture.
  void blur(double sigma, std::uint32_t level) {
    kernel::rpf_pixel_step kernel = gaussian(sigma);
    convolve(kernel, finest_, carried_ + 1, sums_);
    normalize(1, sums_, carried_ + 1, level);
    for (float& weight : kernel.weights) weight *= weight;
    convolve(kernel, finest_ + carried_ + 1, 3, variance_sums_);
    normalize(2, variance_sums_, 3, level + carried_ + 1);
  }

  /// Divides by the sum of the level's weights, or by its square.
  void normalize(int power, std::uint32_t in, std::uint32_t count, std::uint32_t out) {
    kernel::rpf_pixel_step s{};
    s.reach = power;
    planning_.step(RPF_STEP_NORMALIZE, in, sums_ + carried_ + 1, out, count, s);
  }

  PixelPlanning& planning_;
  std::uint32_t carried_;
  std::uint32_t finest_ = 0, mask_ = 0, open_ = 0, levels_[2] = {}, rows_ = 0, sums_ = 0, variance_sums_ = 0,
                stops_ = 0;
};

}  // namespace

void plan_gaussian_bank(const Settings& settings, PixelPlanning& planning, PixelPlan& plan) {
  GaussianBank bank(planning);
  for (int level = 0; level < widths; ++level) bank.add_level(level, most_trust(settings.gamma));
  plan.result = bank.result();
}

}  // namespace rpf
