// The reference: plain loops over the kernels' formulas, parallel over pixels, the same bits for any number of threads.
#pragma once

#include <functional>

#include "parallel/workers.h"
#include "seam/backend.h"

namespace rpf {

class CpuBackend : public Backend {
 public:
  /// `reason`: why it is this backend, where that was not the user's choice.
  explicit CpuBackend(int threads, std::string reason = {}) : reason_(std::move(reason)), threads_(threads) {}

  std::string description() const override { return reason_.empty() ? "cpu" : "cpu (" + reason_ + ")"; }
  void load(const Frame& frame, std::vector<float> colors, const Plan& plan) override;
  void run(int pass, const Window& tile) override;
  void end_pass() override;
  const std::vector<float>& colors() const override { return colors_; }
  std::vector<float> take_colors() override { return std::move(colors_); }
  const std::vector<PixelStatistics>& statistics() const override { return statistics_; }
  const std::vector<float>& explained() const override { return explained_; }
  std::uint64_t scratch_bytes(const Plan& plan, std::uint64_t samples) const override;
  PixelTrace trace(int pass, std::uint32_t pixel) override;
  std::uint64_t trace_bytes(std::uint64_t own, std::uint64_t neighbors) const override {
    return sizeof(float) * own * neighbors;
  }
  void load_estimate(const Frame& frame, const EstimatePlan& plan) override;
  std::vector<float> estimate(const Window& region, const EstimateProgress& progress) override;
  std::vector<EstimateStage> trace_estimate(const Window& region) override;
  std::uint64_t estimate_bytes(const EstimatePlan& plan, const Window& window, std::uint64_t samples) const override;
  std::vector<float> run_steps(const PixelPlan& plan, std::vector<float> planes,
                               const EstimateProgress& progress) override;
  std::uint64_t step_bytes(const PixelPlan& plan) const override;
  std::vector<float> see_views(const LightField& light, const EstimateProgress& progress) override;
  std::vector<float> integrate_columns(const PixelColumns& columns, const EstimateProgress& progress) override;

  struct Workspace;

 private:
  /// [pixel of the window][carried]
  std::vector<float> estimate_window(const Window& window, const EstimateProgress& progress,
                                     std::vector<EstimateStage>* stages);
  /// Runs body(0) .. body(count - 1) on all threads while check_ is called here. Where that throws the bodies end
  /// early: they ask must_stop().
  void run_watched(std::size_t count, const Workers::Body& body);
  /// All sections for a pixel of the tile; nothing for one without samples.
  void filter_pixel(int pass, std::uint32_t pixel, const Window& tile, Workspace& w);
  PixelTrace trace_here(int pass, std::uint32_t pixel) const;
  /// explained() of a pixel of the tile, from what filtering it left in the workspace.
  void keep_explanation(const Window& tile, std::uint32_t pixel, const Workspace& w);

  std::string reason_;
  int threads_;
  const Frame* frame_ = nullptr;
  const Plan* plan_ = nullptr;
  const EstimatePlan* estimate_plan_ = nullptr;
  std::vector<float> colors_, next_colors_;  ///< c' and c'': [sample][carried]
  std::vector<PixelStatistics> statistics_;  ///< [pixel]
  std::vector<float> explained_;             ///< [pixel of the tile][pairs + 1]
};

}  // namespace rpf
