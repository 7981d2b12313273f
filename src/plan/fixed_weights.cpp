#include "plan/fixed_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/box.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Colors are below 2^41 and features within 2^36 of this scale's inverse, so that differences stay finite.
constexpr double largest_scale = 0x1p80;

/// Below it even the largest difference of colors adds nothing to a distance.
constexpr double smallest_scale = 0x1p-100;

float scale_of(double sigma) {
  const double scale = std::min(1 / (std::sqrt(2.0) * sigma), largest_scale);
  return scale < smallest_scale ? 0.0F : static_cast<float>(scale);
}

/// Most samples of the pixels in a box that lies in the frame.
std::uint32_t largest_box(const FrameFacts& facts, int box_width) {
  const auto side = [&](int length) { return static_cast<std::uint64_t>(std::min(box_width, std::max(length, 1))); };
  const std::uint64_t samples = side(facts.width) * side(facts.height) * facts.max_samples_per_pixel;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(samples, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

std::vector<float> centers_of(const FrameFacts& facts, const Settings& settings) {
  if (settings.method == Method::rpf) return {};
  std::vector<float> centers(facts.variables.count(), 0.0F);
  for (std::size_t k = 0; k < facts.feature_spread.size(); ++k)
    centers[facts.variables.features() + k] = facts.feature_spread[k].mean;
  return centers;
}

void plan_fixed_weights(const FrameFacts& facts, const Settings& settings, PassPlan& pass) {
  const auto add = [&](std::size_t variable, double sigma) {
    const float scale = scale_of(sigma);
    if (scale > 0) pass.coordinates.push_back({static_cast<std::uint32_t>(variable), scale});
  };
  for (std::size_t axis = 0; axis < 2; ++axis) add(Variables::position + axis, box_sigma(pass.box_width));
  for (std::size_t c = 0; c < 3 && settings.method != Method::gaussian; ++c)
    add(Variables::color + c, static_cast<double>(settings.sigma_color) * facts.radiance_scale);
  for (std::size_t k = 0; k < facts.feature_spread.size(); ++k)
    add(facts.variables.features() + k, settings.sigma_feature * facts.feature_spread[k].deviation);
  pass.max_neighbors = largest_box(facts, pass.box_width);
  pass.fixed_weights = std::uint64_t{pass.max_neighbors} * kernel::rpf_group_size(facts.max_samples_per_pixel);
}

}  // namespace rpf
