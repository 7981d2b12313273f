#include "explain/contributions.h"

#include <algorithm>
#include <string>

namespace rpf {
namespace {

using kernel::uint;
using Plane = std::vector<double>;  ///< [pixel of the window]

/// All values of one stage, by pixel.
struct Values {
  const EstimateStage& stage;
  const float* of(std::size_t pixel) const { return stage.values.data() + pixel * stage.channels; }
};

Values stage_of(const std::vector<EstimateStage>& stages, const std::string& name) {
  return {*std::find_if(stages.begin(), stages.end(), [&](const EstimateStage& s) { return s.name == name; })};
}

/// The weights of one pass, from what head and means of the guides say.
class Pass {
 public:
  Pass(const EstimatePlan& plan, const std::vector<EstimateStage>& stages, const Window& window, uint pass)
      : head_(stage_of(stages, "head")),
        pixel_(stage_of(stages, "pixel")),
        embedding_(static_cast<uint>(plan.network->embedding)),
        first_(kernel::rpf_head_pass(pass, embedding_)),
        guides_(2 * static_cast<std::size_t>(plan.network->sample_features) + RPF_STATISTIC_GUIDES),
        dilation_(plan.network->dilation(static_cast<int>(pass))),
        width_(window.width),
        height_(window.height) {}

  /// Hands the share of a pixel in what comes out of the pass to the pixels that it comes from.
  void hand_back(std::size_t pixel, double share, Plane& in) const {
    const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
    double total = 0;
    for_taps(x, y, [&](std::size_t other) { total += weight(pixel, other); });
    for_taps(x, y, [&](std::size_t other) { in[other] += share * weight(pixel, other) / total; });
  }

  /// All of them.
  Plane hand_back(const Plane& out) const {
    Plane in(out.size(), 0.0);
    for (std::size_t pixel = 0; pixel < out.size(); ++pixel)
      if (out[pixel] != 0) hand_back(pixel, out[pixel], in);
    return in;
  }

 private:
  template <typename Use>
  void for_taps(int x, int y, Use use) const {
    for (int j = -RPF_PASS_REACH; j <= RPF_PASS_REACH; ++j)
      for (int i = -RPF_PASS_REACH; i <= RPF_PASS_REACH; ++i) {
        const int tx = x + i * dilation_, ty = y + j * dilation_;
        if (tx >= 0 && tx < width_ && ty >= 0 && ty < height_)
          use(static_cast<std::size_t>(ty) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(tx));
      }
  }

  double weight(std::size_t pixel, std::size_t other) const {
    const float *here = head_.of(pixel) + first_, *there = head_.of(other) + first_;
    if (pixel == other) return kernel::rpf_own_weight(here[embedding_]);
    float distance = 0;
    for (uint k = 0; k < embedding_; ++k) {
      const float t = kernel::rpf_embedding(here[k]) - kernel::rpf_embedding(there[k]);
      distance = kernel::fma(t, t, distance);  // the pass's own bits
    }
    for (uint k = 0; k < RPF_GUIDES; ++k) {
      const float t = guide(pixel, here, k) - guide(other, there, k);
      distance = kernel::fma(t, t, distance);
    }
    return kernel::rpf_exp(-distance);
  }

  float guide(std::size_t pixel, const float* head, uint k) const {
    return kernel::rpf_bandwidth(head[embedding_ + 1 + k]) * pixel_.of(pixel)[guides_ + k];
  }

  Values head_, pixel_;
  uint embedding_, first_;
  std::size_t guides_;
  int dilation_, width_, height_;
};

/// Shares in sums become shares in what sums are divided by: pixels count by the weight of their samples.
void weigh_by_sums(const std::vector<EstimateStage>& stages, Plane& shares) {
  const Values sums = stage_of(stages, "sums");
  double total = 0;
  for (std::size_t p = 0; p < shares.size(); ++p) total += shares[p] *= sums.of(p)[RPF_SUM_WEIGHT];
  for (double& share : shares) share = total > 0 ? share / total : 0;
}

std::vector<double> within_pixels(const std::vector<EstimateStage>& stages, const std::vector<std::uint32_t>& samples) {
  const std::vector<float>& weights = stage_of(stages, "weights").stage.values;
  std::vector<double> parts(weights.begin(), weights.end());
  auto first = parts.begin();
  for (const std::uint32_t count : samples) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) sum += first[i];
    for (std::uint32_t i = 0; i < count; ++i) first[i] = sum > 0 ? first[i] / sum : 0;
    first += count;
  }
  return parts;
}

/// docs/network.md, "Result", where radiance is 1: what the blend with the ratio makes of it.
void blend_factors(const Network& network, const std::vector<EstimateStage>& stages, std::size_t pixel,
                   std::array<double, 3>& factor) {
  const auto after = [&](int passes) { return stage_of(stages, "pass" + std::to_string(passes - 1)).of(pixel); };
  const float *sums = after(network.color_passes()), *albedo = after(network.passes());
  const float logit = stage_of(stages, "head").of(pixel)[RPF_HEAD_BLEND];
  const float weight = sums[RPF_SUM_WEIGHT];
  for (std::size_t c = 0; c < 3; ++c)
    factor.at(c) =
        kernel::rpf_blended(1, weight, sums[RPF_SUM_BASE + c], albedo[c], albedo[3], kernel::rpf_blend(logit));
}

}  // namespace

Window region_of_shares(const EstimatePlan& plan, int x, int y) {
  const int reach = pass_reach(*plan.network);
  const int left = std::max(x - reach, 0), top = std::max(y - reach, 0);
  return {left, top, std::min(x + reach + 1, plan.width) - left, std::min(y + reach + 1, plan.height) - top};
}

PixelShares pixel_shares(const EstimatePlan& plan, const std::vector<EstimateStage>& stages, const Window& window,
                         const std::vector<std::uint32_t>& samples, int x, int y) {
  const auto pixel = static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
                     static_cast<std::size_t>(x - window.x);
  PixelShares shares;
  shares.window = window;
  shares.pixels.assign(window.pixel_count(), 0.0);
  shares.pixels[pixel] = 1;
  for (int pass = plan.network->color_passes(); pass-- > 0;)
    shares.pixels = Pass(plan, stages, window, static_cast<uint>(pass)).hand_back(shares.pixels);
  weigh_by_sums(stages, shares.pixels);
  shares.within_pixels = within_pixels(stages, samples);
  if (plan.has_albedo) blend_factors(*plan.network, stages, pixel, shares.factor);
  return shares;
}

}  // namespace rpf
