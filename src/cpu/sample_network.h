// What the learned estimator sees of a sample and of a pixel (docs/network.md, "Inputs of a sample", "Layers" 1, 2, 5).
#pragma once

#include <vector>

#include "cpu/layers.h"
#include "frame/frame.h"
#include "learned/estimate_plan.h"

namespace rpf {

/// One sample as the network sees it.
struct SeenSample {
  float color[3] = {};  ///< c
  float base[3] = {};   ///< a
  float inputs[RPF_INPUTS] = {};
  std::vector<float> hidden;    ///< [S] of sample1
  std::vector<float> features;  ///< [S] h
};

/// Reused from pixel to pixel, one a thread.
class SampleNetwork {
 public:
  SampleNetwork(const Frame& frame, const EstimatePlan& plan);

  /// Inputs and features of a sample of the frame.
  const SeenSample& see(std::size_t sample);
  /// The values of a pixel of the frame. `values`: [2S + 18], `albedo`: [RPF_ALBEDO_SUMS].
  void see_pixel(std::size_t pixel, float* values, float* albedo);
  /// The weight of the sample that was seen last, in its pixel's context [RPF_CONTEXT]; the file's own not included.
  float weight(const float* context);

 private:
  void fill_inputs(const float* record);
  /// What moments are taken of: h, c, luminance, the guides, a.
  void fill_moment_values();
  void add_moments();
  void fill_pixel_values(float samples, float* values) const;
  float mean(std::size_t k, float samples) const;
  float variance(std::size_t k, float samples) const;

  const Frame& frame_;
  const EstimatePlan& plan_;
  NetworkLayer sample1_;     ///< of the inputs that are live
  std::vector<float> live_;  ///< their values
  SeenSample seen_;
  std::vector<float> current_, first_, sums_, squares_;  ///< of what moments are taken of
  std::vector<float> weighed_;                           ///< [S + RPF_CONTEXT] inputs of weight1
};

}  // namespace rpf
