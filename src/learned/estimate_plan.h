// What backends need to know to run the learned estimator: plain data, made by the driver.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "learned/network.h"
#include "rpf/image.h"
#include "rpf_network.h"

namespace rpf {

/// Records of a frame for the learned estimator hold the color (scaled radiance) in columns 0 to 2, then inputs as the
/// network sees them (docs/network.md): missing values are 0, nothing is NaN.
struct EstimatePlan {
  std::shared_ptr<const Network> network;
  int width = 0, height = 0;  ///< of the frame; pixel = y * width + x
  std::size_t carried = 3;    ///< values a sample that are averaged: color, then alpha and features on request
  /// Input (from RPF_INPUT_NORMAL on) -> column of the records; -1: not there. The columns of the albedo are also there
  /// where it is constant, if has_albedo.
  std::array<int, RPF_INPUTS> column = {};
  /// Inputs that vary over the frame, in their order, 0 to 5 always. The others are exactly 0, whatever their column
  /// says, and sample1 leaves them out.
  std::vector<int> live;
  bool has_albedo = false;  ///< else a = 1 for all samples, and the result has no ratio
  float exposure = 1;       ///< power of two: scaled radiance times this is what the network sees
  float weight_scale = 1;   ///< power of two that brings the largest of the frame's weights to [1, 2)

  bool is_live(int input) const;
};

/// The pixels that have to be computed for a region, both in frame coordinates: grown by the network's reach, clipped
/// to the frame, its upper left corner on a multiple of 2^(levels - 1). To backends it is as if it were the frame: the
/// halo's own pixels come out wrong, those of the region do not. So level l has ceil(size / 2^l) cells.
Window window_around(const EstimatePlan& plan, const Window& region);

/// Called between bounded pieces of work, from the calling thread, with the part of this estimate() that was done since
/// the last call: they sum to 1. Throws where the run shall stop.
using EstimateProgress = std::function<void(double part)>;

/// One stage of the estimator over window_around(region), all its values, so that backends are compared stage by stage.
/// In this order: "inputs" [sample][30], "sample1", "sample2" [sample][S], "pixel" [pixel][2S + 18], the layers from
/// "enter" to "up0b" by name, each [cell of its level][outputs], "head", "weights" [sample] (the file's weight
/// included), "sums" [pixel][rpf_sums()], "pass0" and so on likewise, "albedo" [pixel][4], its passes likewise,
/// "result" [pixel][carried]. Samples are those of the window's pixels, row by row.
struct EstimateStage {
  std::string name;
  std::size_t channels = 0;  ///< values side by side
  std::vector<float> values;
};

}  // namespace rpf
