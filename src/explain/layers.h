// The layers of an explanation: named channels of one image.
#pragma once

#include "explain/attribution.h"
#include "frame/prepare.h"
#include "rpf/explain.h"
#include "seam/backend.h"

namespace rpf {

/// Fills an image [pixel][channel] step by step, each step some channels.
class Layers {
 public:
  /// Their channels.
  static std::vector<std::string> names(const Variables& variables, const std::vector<RandomGroup>& groups);
  /// How many channels there are.
  static std::size_t count(std::size_t features, std::size_t groups) { return 30 + features + 2 * groups; }

  Layers(const PreparedFrame& prepared, const Plan& plan, const std::vector<RandomGroup>& groups);

  /// What a pass found in a tile: W, alpha, beta, mutual information, neighborhood.
  void add_tile(const Backend& backend, const Window& tile);
  /// Pixels [pixel][carried] before and after the pass; the image's own R, G, B and filtered.*.
  void add_colors(const std::vector<float>& mean, const std::vector<float>& filtered);
  /// Means of what the samples hit: normal.*, position.*.
  void add_features();
  /// Shares, and what follows from them and all the above: noise.* and density. `filtered`: samples [sample][carried]
  /// after the pass.
  void add_noise(const Attribution& attribution, const std::vector<float>& filtered);

  /// `geometry`: windows and metadata.
  Image take(Image geometry);

 private:
  float& value(std::size_t pixel, std::size_t channel) { return values_[pixel * names_.size() + channel]; }
  std::size_t channel(const std::string& name) const;
  void explain_dependencies(const float* information, std::size_t pixel);
  /// The variance that the filtered samples of a pixel still have, summed over R, G and B: means over the pixels
  /// around, in the unit of Attribution.
  std::vector<float> kept_variance(const std::vector<float>& filtered) const;
  /// noise.* of a pixel from its variances of samples before and after the pass, means over R, G and B in squares of
  /// radiance. Returns noise.relative.
  double estimate_noise(std::size_t pixel, double variance, double kept);
  void suggest_density(const std::vector<double>& relative);
  void add_mean(const std::string& layer, const std::string& group);

  const PreparedFrame& prepared_;
  const Plan& plan_;
  const std::vector<RandomGroup>& groups_;
  std::vector<std::string> names_;
  std::vector<float> values_;  ///< [pixel][name]
  // Numbers of the channels where groups of them begin.
  std::size_t fraction_random_, share_, neighborhood_, noise_, density_;
};

}  // namespace rpf
