// The learned estimator over one window, stage after stage (docs/network.md).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cpu/layers.h"
#include "cpu/passes.h"
#include "cpu/sample_network.h"
#include "frame/frame.h"
#include "learned/estimate_plan.h"

namespace rpf {

/// Calls row(y) for every row of 0 .. rows - 1, in any order and in parallel. `row_work`: multiply-adds of one.
using RowLoop = std::function<void(int rows, double row_work, const std::function<void(int)>& row)>;

class Estimate {
 public:
  /// With `stages` every stage is kept there (estimate_plan.h).
  Estimate(const Frame& frame, const EstimatePlan& plan, const Window& window, RowLoop for_rows,
           std::vector<EstimateStage>* stages = nullptr);

  /// [pixel of the window][carried]
  std::vector<float> run();

  /// Multiply-adds of run() with so many samples, about: the sum of what `for_rows` is told.
  static double work(const EstimatePlan& plan, const Window& window, double samples);
  /// Peak bytes of run().
  static std::uint64_t bytes(const EstimatePlan& plan, const Window& window);

 private:
  std::size_t frame_pixel(int x, int y) const {
    return static_cast<std::size_t>(window_.y + y) * static_cast<std::size_t>(frame_.width) +
           static_cast<std::size_t>(window_.x + x);
  }
  /// The head's outputs first .. first + count - 1 of a pixel.
  void head(int x, int y, kernel::uint first, kernel::uint count, float* out) const;

  /// for_rows_ over all rows, of stages that read samples.
  void for_rows_of_samples(double row_work, bool again, const std::function<void(int)>& row);
  Field see_pixels();
  Field convolved(const NetworkLayer& layer, const std::vector<Source>& sources, int width, int height);
  Field halved(const Field& in);
  void run_layers();
  void sum_samples();
  void sum_pixel(int x, int y, SampleNetwork& samples);
  PassWeights weights_of(int pass);
  void run_passes(Rows& values, int first, int end);
  std::vector<float> results();
  void result_of(int x, int y, float* out) const;

  void keep(const std::string& name, const Field& field);
  void keep(const std::string& name, const Rows& rows);
  void keep_samples();
  void keep_head();

  const Frame& frame_;
  const EstimatePlan& plan_;
  const Network& network_;
  Window window_;
  RowLoop for_rows_;
  std::vector<EstimateStage>* stages_;
  std::vector<std::uint32_t> first_sample_;  ///< [pixel of the window + 1] in the window's own count
  std::vector<float> sample_weights_;        ///< [sample of the window], where stages are kept

  Rows guides_;  ///< means of the guides
  Rows albedo_;  ///< [RPF_ALBEDO_SUMS]
  Field last_;   ///< of the layers: what the head reads
  Rows sums_;    ///< [rpf_sums()]
};

}  // namespace rpf
